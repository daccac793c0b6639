#include "reports/paraview.hpp"

namespace proveta::report {

const std::string& paraview_script() {
    static const std::string script = R"py(# The standard views of this folder's results in ParaView.
#   paraview --script=views.py      to look at them
#   pvpython views.py --save        to write view_displacement.png and so on beside this file
import os
import sys

from paraview.simple import *

here = os.path.dirname(os.path.abspath(__file__)) if "__file__" in globals() else os.getcwd()


def series(part):
    """Reader of one part over physical time in seconds, or None."""
    path = os.path.join(here, part + ".pvd")
    return PVDReader(registrationName=part, FileName=path) if os.path.exists(path) else None


spheres, bonds, platens, membrane = (series(part) for part in ("spheres", "bonds", "platens", "membrane"))
spheres.UpdatePipeline()
times = list(spheres.TimestepValues) if hasattr(spheres.TimestepValues, "__len__") else [spheres.TimestepValues]
low_x, high_x, low_y, high_y, low_z, high_z = spheres.GetDataInformation().GetBounds()
middle = [0.5 * (low_x + high_x), 0.5 * (low_y + high_y), 0.5 * (low_z + high_z)]
size = high_z - low_z


def balls(source):
    """Spheres of their true size."""
    glyph = Glyph(Input=source, GlyphType="Sphere")
    glyph.ScaleArray = ["POINTS", "radius"]
    glyph.ScaleFactor = 2.0  # the glyph has a diameter of 1
    glyph.OrientationArray = ["POINTS", "No orientation array"]
    glyph.GlyphMode = "All Points"
    glyph.GlyphType.ThetaResolution = 12
    glyph.GlyphType.PhiResolution = 12
    return glyph


def view_of(name, azimuth=30.0):
    view = CreateView("RenderView", name)
    view.ViewSize = [900, 1100]
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesVisibility = 0
    view.CameraFocalPoint = middle
    view.CameraPosition = [middle[0], middle[1] - 3.2 * size, middle[2] + 0.5 * size]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    view.ViewTime = times[-1]
    return view


def coloured(source, view, array, where="POINTS"):
    display = Show(source, view)
    ColorBy(display, (where,) + array)
    display.RescaleTransferFunctionToDataRange(True)
    display.SetScalarBarVisibility(view, True)
    bar = GetScalarBar(GetColorTransferFunction(array[0]), view)
    bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]
    return display


all_balls = balls(spheres)
half = Clip(registrationName="half", Input=spheres, ClipType="Plane")
half.ClipType.Origin = middle
half.ClipType.Normal = [0.0, -1.0, 0.0]
half_balls = balls(half)

views = {}
views["displacement"] = view_of("displacement")
coloured(all_balls, views["displacement"], ("displacement", "Magnitude"))
views["damage"] = view_of("damage")
coloured(half_balls, views["damage"], ("damage",))
views["stress"] = view_of("stress")
coloured(half_balls, views["stress"], ("stress", "2"))
if bonds is not None:
    broken = Threshold(registrationName="cracks", Input=bonds)
    broken.Scalars = ["CELLS", "mode"]
    broken.LowerThreshold, broken.UpperThreshold = 0.5, 2.5
    front = Clip(Input=broken, ClipType="Plane")
    front.ClipType.Origin = middle
    front.ClipType.Normal = [0.0, -1.0, 0.0]
    layer = Clip(registrationName="cracks about the axis", Input=front, ClipType="Plane")
    layer.ClipType.Origin = [middle[0], middle[1] + 0.04 * size, middle[2]]
    layer.ClipType.Normal = [0.0, 1.0, 0.0]
    views["cracks"] = view_of("cracks")
    shown = coloured(layer, views["cracks"], ("mode",), "CELLS")
    shown.LineWidth = 3.0
for view in views.values():
    for part, opacity in ((platens, 0.3), (membrane, 0.25)):
        if part is not None:
            display = Show(part, view)
            display.Opacity = opacity
            display.ColorArrayName = ["POINTS", ""]
            display.AmbientColor = display.DiffuseColor = [0.4, 0.45, 0.5]
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
GetAnimationScene().AnimationTime = times[-1]
if "--save" in sys.argv:
    for name, view in views.items():
        SaveScreenshot(os.path.join(here, "view_" + name + ".png"), view, ImageResolution=[900, 1100])
else:
    RenderAllViews()
)py";
    return script;
}

} // namespace proveta::report
