// Deformable bodies for tests, alone and under spheres whose motion is prescribed.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "core/boundaries/walls.hpp"
#include "core/solids/solid_shapes.hpp"

namespace proveta::testing {

/// Random numbers.
class Dice {
  public:
    explicit Dice(unsigned seed) : engine_(seed) {}
    double operator()(double low, double high) { return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0); }
    Vec3 in_box(double half) { return {(*this)(-half, half), (*this)(-half, half), (*this)(-half, half)}; }
    Mat3 matrix(double half) {
        Mat3 m;
        m << in_box(half), in_box(half), in_box(half);
        return m;
    }
    Eigen::Quaterniond attitude() {
        const Vec3 v = in_box(1.0);
        return Eigen::Quaterniond((*this)(-1, 1), v.x(), v.y(), v.z()).normalized();
    }
    Mat3 turn() { return attitude().toRotationMatrix(); }

  private:
    std::mt19937 engine_;
};

/// Every law and form that a deformable body can have.
constexpr SolidLaw laws[] = {SolidLaw::kirchhoff, SolidLaw::neo_hookean, SolidLaw::j2};
enum class BodyKind { tetrahedra, hexahedra, membrane };
constexpr BodyKind kinds[] = {BodyKind::tetrahedra, BodyKind::hexahedra, BodyKind::membrane};

/// Soft, and plastic at a twentieth of its modulus if its law is.
inline SolidMaterial soft_solid(SolidLaw law, double yield_stress = 1e5) {
    SolidMaterial m;
    m.law = law;
    m.density = 1200.0;
    m.young_modulus = 2e6;
    m.poisson_ratio = 0.3;
    m.yield_stress = yield_stress;
    m.hardening = 1e5;
    return m;
}

/// A body whose membranes, if it has any, are 2 mm thick.
inline Solid solid_of(SolidMesh mesh, const SolidMaterial& m) { return {"body", std::move(mesh), m, 0.002}; }

/// Largest step that the elements of a body are stable with, by its bound, s.
inline double stable(const Solid& s) {
    double lowest = 1e300;
    for (const auto& d : s.demands()) {
        lowest = std::min(lowest, 4.0 / (d.damping + std::sqrt(d.damping * d.damping + 4.0 * d.stiffness)));
    }
    return lowest;
}

inline const std::vector<std::uint32_t>& group(const Solid& s, const std::string& name) {
    for (const auto& g : s.mesh().groups) {
        if (g.name == name) {
            return g.node;
        }
    }
    throw std::logic_error(name);
}

inline NodeHold hold(const Solid& s, const std::string& name, std::array<bool, 3> axes = {true, true, true}) {
    return {name, group(s, name), axes, -1, Vec3::Zero(), Vec3::Zero()};
}

/// Everything that goes in and out of a body.
struct Run {
    Solid& s;
    Team team{2};
    double dt = 0.0;
    bool first = true;
    Vec3 gravity = Vec3::Zero();
    double held = 0.0, pressure = 0.0, rayleigh = 0.0, weighed = 0.0, kinetic = 0.0;

    void step() {
        s.forces(team);
        const SolidSums sums = s.move(team, dt, first, gravity, {});
        first = false;
        kinetic = sums.kinetic;
        held += sums.held;
        pressure += sums.pressure;
        rayleigh += sums.rayleigh;
        weighed += sums.body;
    }
    [[nodiscard]] double energy() const { return kinetic + s.stored(); }
    [[nodiscard]] double residual() const { return held + pressure + weighed - rayleigh - s.plastic() - energy(); }
};

inline Material grain(ContactLaw law, double friction, double restitution, double rolling) {
    Material m;
    m.density = 2000.0;
    m.young_modulus = 1e7;
    m.contact_law = law;
    m.contact_restitution = restitution;
    m.rolling_friction = rolling;
    m.mu_d = friction;
    return m;
}

inline Solid rubber(SolidMesh mesh) {
    SolidMaterial m;
    m.law = SolidLaw::neo_hookean;
    return {"rubber", std::move(mesh), m, 0.002};
}

/// Spheres and one body whose motions are prescribed.
struct CouplingBench {
    Spheres spheres;
    Deformable body;
    std::vector<Material> material;
    Team team{1};
    Loads loads;

    CouplingBench(SolidMesh mesh, const Material& m, Coupling how, double side)
        : body(rubber(std::move(mesh)), m, m.mu_d, how, side), material{m} {
        spheres.packed = false;
    }
    void list(double skin) { search_deformable(spheres, material, skin, body, team); }
    SkinSums advance(double elapsed) {
        body.skin.follow(body.solid.position, body.solid.velocity, team);
        loads = Loads(spheres.size());
        std::fill(body.solid.contact.begin(), body.solid.contact.end(), Vec3::Zero());
        SkinSums sums;
        for (std::size_t k = 0; k < loads.blocks().size(); ++k) {
            sums.add(deformable_forces(spheres, body, k, loads.blocks()[k], {elapsed, elapsed}, loads));
        }
        collect_node_loads(body);
        return sums;
    }
    void move(double dt) {
        for (std::size_t k = 0; k < spheres.size(); ++k) {
            spheres.position.set(k, spheres.position.at(k) + dt * spheres.velocity.at(k));
        }
        for (std::size_t k = 0; k < body.solid.nodes(); ++k) {
            body.solid.position[k] += dt * body.solid.velocity[k];
        }
    }
    Vec3 force(std::size_t k) { return {loads.row(k).force[0], loads.row(k).force[1], loads.row(k).force[2]}; }
    Vec3 torque(std::size_t k) { return {loads.row(k).torque[0], loads.row(k).torque[1], loads.row(k).torque[2]}; }
};

/// The force on the only sphere at a place, without history.
inline Vec3 force_at(CouplingBench& b, const Vec3& centre) {
    b.spheres.position.set(0, centre);
    b.list(0.0);
    for (auto& block : b.body.touches) {
        block.clear();
    }
    b.advance(1e-9);
    return b.force(0);
}

constexpr Coupling both[] = {Coupling::area_distributed, Coupling::direct};

} // namespace proveta::testing
