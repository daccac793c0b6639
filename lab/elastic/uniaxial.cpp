#include "lab/elastic/uniaxial.hpp"

#include <cmath>

#include "lab/axial_results.hpp"

namespace proveta {

namespace {

// What is left of rigid motion between platens without friction: held without any reaction, at two spheres far apart.
std::vector<Support> hold_still(const Spheres& s) {
    std::size_t far = 0;
    for (std::size_t k = 0; k < s.size(); ++k) {
        if (std::fabs(s.position.x[k] - s.position.x[0]) > std::fabs(s.position.x[far] - s.position.x[0])) {
            far = k;
        }
    }
    if (s.planar) {
        return {{0, 0, 0.0}};
    }
    return {{0, 0, 0.0}, {0, 1, 0.0}, {far, 1, 0.0}};
}

} // namespace

UniaxialReading press_uniaxially(const Shape& shape, const Spheres& spheres, const std::vector<Material>& materials, const Bonds& bonds,
                                 bool friction, const ElasticSolution* start, double tolerance) {
    const double travel = 1e-6 * shape.height; // linear: any small value does
    Press press = axial_press(spheres, shape, friction ? glued : 0.0, 1.0);
    std::vector<Bearing> bearings;
    for (auto& platen : press.platens) {
        search_platen(spheres, materials, 0.0, platen);
        const double moves = platen.face.inward < 0.0 ? -travel : 0.0;
        for (std::size_t k = 0; k < platen.sphere.size(); ++k) {
            const auto sphere = static_cast<std::size_t>(platen.sphere[k]);
            const auto foot = platen.foot(spheres.position.at(sphere));
            const Mat3 nn = foot.normal * foot.normal.transpose();
            Mat3 stiffness = platen.law[k].k_n * nn;
            if (friction) {
                stiffness += platen.law[k].k_t * (Mat3::Identity() - nn);
            }
            bearings.push_back({sphere, stiffness, -foot.distance * foot.normal, moves * platen.face.axis});
        }
        if (platen.sphere.empty()) {
            throw std::invalid_argument("no spheres at the ends");
        }
    }
    // Spheres of a single bond can roll about it: a weak anchor keeps them.
    const ElasticOptions options{.direct_in_space = 0, .tolerance = tolerance, .anchor = 1e-10};
    UniaxialReading out;
    out.solution = solve_elastic(spheres, bonds, friction ? std::vector<Support>{} : hold_still(spheres), options, bearings, start);

    double force = 0.0; // both platens', each against its face
    for (const auto& b : bearings) {
        const Vec3 point = out.solution.displacement.at(b.sphere) + out.solution.rotation.at(b.sphere).cross(b.arm);
        force += std::fabs((b.stiffness * (b.motion - point)).z());
    }
    const double stress = 0.5 * force / shape.section();
    // A specimen between platens without friction keeps its centre of mass; here it is held at single spheres.
    Vec3 drift = Vec3::Zero();
    double volume = 0.0;
    for (std::size_t k = 0; k < spheres.size(); ++k) {
        drift += spheres.volume(k) * out.solution.displacement.at(k);
        volume += spheres.volume(k);
    }
    drift = friction ? Vec3::Zero().eval() : Vec3(drift.x() / volume, drift.y() / volume, 0.0);
    VectorField moved = spheres.start;
    for (std::size_t k = 0; k < moved.size(); ++k) {
        moved.set(k, moved.at(k) + out.solution.displacement.at(k) - drift);
    }
    const std::vector<std::uint8_t> nobody(spheres.size(), 0);
    const Gauges gauges(shape, spheres);
    const double axial = gauges.axial_strain(moved, nobody);
    out.young_modulus = stress / axial;
    out.poisson_ratio = -gauges.girth_strain(moved, nobody) / axial;
    out.travel_modulus = stress * shape.height / travel;
    return out;
}

} // namespace proveta
