#include "lab/membrane.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/solids/solid_shapes.hpp"

namespace proveta {

using input::Unit;

void declare(input::Visitor& v, MembraneInput& m) {
    v.number("thickness", m.thickness, Unit::length, {0.0, 0.1, true, false}, "thickness of the rubber");
    v.number("young_modulus", m.young_modulus, Unit::pressure, input::above(0), "Young's modulus at small strain");
    v.number("poisson_ratio", m.poisson_ratio, Unit::none, {0.0, 0.5, false, true}, "Poisson's ratio at small strain, below 1/2");
    v.number("density", m.density, Unit::density, input::above(0), "of the rubber");
    v.choice("law", m.law, {{"neo_hookean", "any stretch (4.37-4.39)"}, {"kirchhoff", "any rotation, small stretch (4.34)"}},
             "constitutive law");
    v.number("friction", m.friction, Unit::none, input::between(0, 10), "Coulomb friction between specimen and membrane");
    v.number_or_word("element", m.element, {{"auto", "0.4 mean sizes of a stone; of bonded spheres 2 mean diameters"}}, Unit::length,
                     input::above(0), "edge of its triangles");
    v.number_or_word("damping", m.damping, {{"auto", "one over the time in which a wave crosses the specimen"}}, Unit::rate,
                     input::at_least(0), "Rayleigh damping in proportion to mass (4.72)");
}

Deformable make_membrane(const MembraneInput& in, const Wrapped& wrapped) {
    const Shape& shape = wrapped.shape;
    if (shape.kind != ShapeKind::cylinder) {
        throw std::invalid_argument("a membrane around a specimen that is not round");
    }
    const double edge = in.element.word.empty() ? in.element.number : wrapped.grain;
    double reach = 0.5 * shape.diameter;
    for (std::size_t k = 0; k < wrapped.spheres.size(); ++k) {
        reach = std::max(reach, std::hypot(wrapped.spheres.position.x[k], wrapped.spheres.position.y[k]) + wrapped.spheres.radius[k]);
    }
    const int around = std::max(12, static_cast<int>(std::lround(2.0 * std::numbers::pi * reach / edge)));
    const double radius = reach / std::cos(std::numbers::pi / around);              // its facets just touch
    const double high = std::sqrt(0.75) * 2.0 * std::numbers::pi * radius / around; // of an equilateral triangle
    const int layers = std::max(4, static_cast<int>(std::lround(shape.height / high)));
    SolidMaterial rubber;
    rubber.name = "membrane";
    rubber.law = in.law == "kirchhoff" ? SolidLaw::kirchhoff : SolidLaw::neo_hookean;
    rubber.density = in.density;
    rubber.young_modulus = in.young_modulus;
    rubber.poisson_ratio = in.poisson_ratio;
    rubber.mass_damping = in.damping.word.empty() ? in.damping.number : 1.0 / wrapped.crossing;
    const SolidMesh mesh = tube_membrane(radius, shape.height, around, layers);
    Solid solid("membrane", mesh, rubber, in.thickness);
    for (const auto& group : mesh.groups) {
        if (group.name == "z-" || group.name == "z+") {
            NodeHold hold;
            hold.name = group.name == "z-" ? "lower end" : "upper end";
            hold.node = group.node;
            hold.platen = group.name == "z-" ? 0 : 1;
            solid.holds.push_back(hold);
        }
    }
    solid.pressures.push_back({0.0, mesh.membranes, 1.0});
    return {std::move(solid), wrapped.surface, in.friction, Coupling::area_distributed, -1.0};
}

// Half the flux of (x, y, 0) through the surface: the plane ends have none.
double enclosed_volume(const Deformable& membrane) {
    const auto& at = membrane.solid.position;
    double sum = 0.0;
    for (const auto& t : membrane.solid.mesh().membranes) {
        const Vec3 area = 0.5 * (at[t[1]] - at[t[0]]).cross(at[t[2]] - at[t[0]]);
        const Vec3 middle = (at[t[0]] + at[t[1]] + at[t[2]]) / 3.0;
        sum += middle.x() * area.x() + middle.y() * area.y();
    }
    return 0.5 * sum;
}

double middle_radius(const Deformable& membrane) {
    const auto& start = membrane.solid.mesh().node;
    double top = 0.0;
    for (const auto& p : start) {
        top = std::max(top, p.z());
    }
    double nearest = top; // ring to the middle
    for (const auto& p : start) {
        nearest = std::min(nearest, std::fabs(p.z() - 0.5 * top));
    }
    const double window = std::max(top / 12.0, nearest) * (1.0 + 1e-9);
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t k = 0; k < start.size(); ++k) {
        if (std::fabs(start[k].z() - 0.5 * top) <= window) {
            sum += std::hypot(membrane.solid.position[k].x(), membrane.solid.position[k].y());
            count += 1.0;
        }
    }
    return sum / count;
}

double pressure_inside(const Deformable& membrane) {
    double inward = 0.0;
    for (const auto& block : membrane.touches) {
        for (const auto& t : block) {
            inward -= t.force.x() * t.point.x() + t.force.y() * t.point.y();
        }
    }
    return 0.5 * inward / enclosed_volume(membrane);
}

double axial_force(const Deformable& membrane) {
    const auto& holds = membrane.solid.holds;
    return 0.5 * (holds[1].reaction.z() - holds[0].reaction.z());
}

} // namespace proveta
