// A rubber membrane around a specimen, held by the platens, under the cell's pressure from outside (thesis 6.3).
#pragma once

#include "core/coupling/deformable.hpp"
#include "core/input/declare.hpp"
#include "core/particles/spheres.hpp"
#include "specimens/shape.hpp"

namespace proveta {

/// Keys of a "membrane" section.
struct MembraneInput {
    double thickness = 0.004;     ///< m
    double young_modulus = 1.0e6; ///< Pa
    double poisson_ratio = 0.48;
    double density = 1100.0; ///< kg/m3
    std::string law = "neo_hookean";
    double friction = 0.3;
    input::NumberOrWord element{0.0, "auto"}; ///< m
    input::NumberOrWord damping{0.0, "auto"}; ///< 1/s
};

void declare(input::Visitor& v, MembraneInput& membrane);

/// What the membrane is wrapped around.
struct Wrapped {
    const Shape& shape;      ///< a cylinder
    const Spheres& spheres;  ///< that it is wrapped around, touching at most
    double grain = 0.0;      ///< mean size of what presses against it, m
    double crossing = 0.0;   ///< time in which a wave crosses the specimen, s
    const Material& surface; ///< that contacts are reckoned with: the grains' own, as the rubber's own stiffness is in its elements
};

/// The membrane between the first two platens, without stress on the cylinder's side. Its ends go with the platens; the pressure on its
/// outer face is `solid.pressures.front()`. Throws std::invalid_argument for shapes that are not round.
Deformable make_membrane(const MembraneInput& input, const Wrapped& wrapped);

/// Volume between membrane and platens, m3: exact, as the ends of the membrane stay plane.
double enclosed_volume(const Deformable& membrane);

/// Mean distance of the membrane from the axis within a sixth of the height about the middle, m.
double middle_radius(const Deformable& membrane);

/// What the membrane presses on the specimen with, Pa: that of the contacts' forces at the last step which does work when the volume inside
/// changes all round. What the rubber's own tension adds to the cell's pressure is in it; what its ends hand over to the platens is not.
double pressure_inside(const Deformable& membrane);

/// Force that the membrane itself bears along the axis, compression positive: mean of both ends, N.
double axial_force(const Deformable& membrane);

} // namespace proveta
