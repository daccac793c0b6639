// A pressure on the surface of a bonded specimen: forces on its surface spheres (thesis 5.5.3).
//
// The surface is a net of triangles between the centres of the surface spheres, so that the pressure follows the specimen however it
// deforms. As the net of a closed surface, or one closed by the platens, has no net area, the pressure pushes it nowhere; and as the
// shares of its facets are balanced, it turns it nowhere either, which lubricated platens would not hinder.
#pragma once

#include <array>
#include <vector>

#include "core/contacts/loads.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// Triangle of a surface: positions in the list of surface spheres, counterclockwise seen from outside.
using SurfaceTriangle = std::array<std::uint32_t, 3>;

/// A pressure on a net of facets. Each facet's force -p A n, with its present area A and outward normal n, is shared out among its spheres
/// nearly in proportion to their sections: a small sphere between large ones lies in their shelter. Such forces act beside the middles of
/// the facets, where a pressure's resultants are, and all together would turn the specimen: the shares are moved by the little (some
/// thousandths) that takes this moment away. It stays away however the specimen turns.
struct Pressure {
    double value = 0.0;               ///< Pa, positive presses inwards
    std::vector<std::int32_t> sphere; ///< ascending
    std::vector<double> raise;        ///< by which a sphere of the rim is lifted to where the surface ends, m; one a sphere
    double scale = 1.0; ///< true surface over that of the net, seen along the true normals, at the start: centres lie below it
    std::vector<std::uint32_t> offset;                ///< of each sphere into `others`, and the end
    std::vector<std::array<std::uint32_t, 2>> others; ///< the other corners of its facets, in their order
    std::vector<double> share;                        ///< of each such facet's area that the sphere takes
    VectorField force;                                ///< of the last step, N
};

/// A pressure on the given facets. spheres: the model's, at the start; sphere, raise: as in Pressure; normal: of the true surface, outward,
/// one a sphere; surface: true area that the net stands for, m2. The net is rough: what counts is what it shows along those normals.
Pressure make_pressure(const Spheres& spheres, std::vector<std::int32_t> sphere, std::vector<double> raise, const VectorField& normal,
                       const std::vector<SurfaceTriangle>& facets, double surface);

/// Adds the forces of the pressure on one block of spheres to the loads. `force` has one entry a sphere of the pressure. Returns the work
/// done in the step of dt seconds, J.
double pressure_forces(const Spheres& spheres, Pressure& pressure, const SphereBlock& block, double dt, Loads& loads);

/// What the forces of the last step come to over the surface as it is now: the pressure, even all round, that would do the same work on a
/// small swelling of the side, Pa. Across z alone, as the ends are the platens'.
double side_stress(const Spheres& spheres, const Pressure& pressure);

} // namespace proveta
