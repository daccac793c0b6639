// A script that opens a folder's field files in ParaView.
#pragma once

#include <string>

namespace proveta::report {

/// Python for pvpython, or for `paraview --script=`: the series of the folder it lies in, with the standard views: displacement, damage in
/// a cut, cracks, stress; stills with `pvpython views.py --save`.
const std::string& paraview_script();

} // namespace proveta::report
