// A deformable body: its elements' forces, its nodes' motion, its energies, its stable step (thesis 4.2 and 4.4).
//
// Lumped masses, central differences in the same leapfrog form as the spheres: positions at time t, velocities at t - dt/2 when a step
// begins. Forces of elements are kept corner by corner and gathered node by node, so that sums do not depend on threads.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "core/parallel/team.hpp"
#include "core/solids/element_point.hpp"
#include "core/solids/solid_material.hpp"
#include "core/solids/solid_mesh.hpp"

namespace proveta {

/// Nodes whose motion is given along some axes. Several may share a node; of those that hold it along one axis the last does.
struct NodeHold {
    std::string name;
    std::vector<std::uint32_t> node;
    std::array<bool, 3> axes{true, true, true};
    std::int32_t platen = -1;     ///< of the walls: they go with it; -1: by `velocity`
    Vec3 velocity = Vec3::Zero(); ///< along the held axes, m/s; set between steps
    Vec3 reaction = Vec3::Zero(); ///< of the body on what holds it, at the last step, N
};

/// A pressure on facets of the body; it follows them. Positive presses against the side that they face to.
struct NodePressure {
    double value = 0.0; ///< Pa; set between steps
    std::vector<SolidMesh::Triangle> facet;
    double share = 1.0; ///< of the pressure that each facet bears: 1/2 where quadrilaterals are cut along both diagonals
};

/// Sums over a body's nodes in one step; energies in J. Works are those of the step.
struct SolidSums {
    double kinetic = 0.0;  ///< at the time of the forces
    double rayleigh = 0.0; ///< dissipated
    double held = 0.0;     ///< work of what holds it
    double pressure = 0.0; ///< work of the pressures
    double body = 0.0;     ///< work of gravity
    double fastest = 0.0;  ///< highest speed, m/s; not a number if any is not
};

class Solid {
  public:
    Solid() = default;
    /// thickness: of membranes, m. Throws std::invalid_argument with what is wrong with the mesh.
    Solid(std::string called, SolidMesh mesh, const SolidMaterial& of, double sheet_thickness = 0.0);

    std::string name;
    SolidMaterial material;
    double thickness = 0.0;
    std::vector<Vec3> position, velocity; ///< m, m/s
    std::vector<NodeHold> holds;
    std::vector<NodePressure> pressures;
    std::vector<Vec3> contact; ///< forces on the nodes from outside, N: emptied by each move

    [[nodiscard]] const SolidMesh& mesh() const { return mesh_; }           ///< as it is without stress
    [[nodiscard]] const std::vector<double>& mass() const { return mass_; } ///< of the nodes, kg
    [[nodiscard]] double stored() const { return stored_; }                 ///< elastic energy at the last forces, J
    [[nodiscard]] double plastic() const { return plastic_; }               ///< plastic work so far, J
    [[nodiscard]] std::size_t nodes() const { return position.size(); }

    /// Forces of the elements at the positions now. Plastic strains advance: once a step.
    void forces(Team& team);
    /// Moves the nodes by dt seconds. first: velocities are those of the positions' time. platens: velocity of each along its axis, as
    /// vectors, m/s. kick: as `MotionRule::kick`.
    SolidSums move(Team& team, double dt, bool first, const Vec3& gravity, const std::vector<Vec3>& platens, double kick = 0.0);

    /// What the elements ask of each node: stiffness and damping over its mass, such that stiffness dt^2 + 2 damping dt <= 4 is stable.
    /// Of the reference each element's highest frequency is exact; it is taken to grow with the element's deformation as a bound on it
    /// does.
    struct NodeDemand {
        double stiffness, damping; ///< 1/s2, 1/s
    };
    [[nodiscard]] std::vector<NodeDemand> demands() const;

    /// Sum of all elements' forces on the nodes at the last `forces`, without pressures and contacts, N.
    [[nodiscard]] std::vector<Vec3> element_forces() const;
    /// Largest accumulated plastic strain of each element; empty for elastic materials.
    [[nodiscard]] std::vector<double> plastic_strain() const;
    /// Mean true stress of each element, Pa: tetrahedra, hexahedra, membranes.
    [[nodiscard]] std::vector<Mat3> stresses() const;
    [[nodiscard]] Vec3 momentum() const; ///< kg m/s

    /// As `Model::visit_state`; names begin with `prefix`.
    template <class Visit> void visit_state(const std::string& prefix, Visit&& visit);

  private:
    void set_up_points();
    void set_up_gather();
    void set_up_holds();
    // Calls use(nodes of an element, number of its corners) for all elements in their order.
    template <class Use> void each_corner_list(const Use& use) const {
        const auto list = [&](const auto& elements) {
            for (const auto& e : elements) {
                use(e.data(), e.size());
            }
        };
        list(mesh_.tetrahedra);
        list(mesh_.hexahedra);
        list(mesh_.membranes);
    }
    void element_block(std::size_t block);
    template <int N, class Points>
    void solid_element(const std::array<std::uint32_t, static_cast<std::size_t>(N)>& nodes, const Points& points, std::size_t corner,
                       std::size_t state, std::size_t element, PointSums& sums);
    void press(std::vector<Vec3>& out) const;
    [[nodiscard]] double reference_frequency(std::size_t element) const;
    [[nodiscard]] double bound(std::size_t element, bool deformed) const;

    SolidMesh mesh_;
    std::vector<double> mass_;
    std::vector<double> corner_mass_; // of each element's corners, kg
    std::vector<ElementPoint<4>> tetrahedra_;
    std::vector<std::array<ElementPoint<8>, 8>> hexahedra_;
    std::vector<ElementPoint<3, 2>> membranes_;
    std::vector<PlasticState> plastic_states_; // of all points of j2
    std::vector<double> across_;               // stretch of membranes in thickness
    std::vector<double> stress_;               // of each element, roughly, Pa
    std::vector<double> frequency_;            // square of each element's highest in the reference, 1/s2
    std::vector<double> frequency_bound_;      // a bound on the same
    std::vector<Vec3> elastic_, damping_;      // forces corner by corner, N
    std::vector<std::uint32_t> offset_, from_; // corners of each node
    std::vector<PointSums> block_sums_;
    std::vector<SolidSums> node_sums_;
    std::vector<std::array<std::int32_t, 3>> hold_of_; // of each node along each axis; -1: free
    std::vector<Vec3> pressing_;
    double stored_ = 0.0;
    double plastic_ = 0.0;
};

template <class Visit> void Solid::visit_state(const std::string& prefix, Visit&& visit) {
    const auto field = [&](const std::string& what, std::vector<Vec3>& values) {
        std::vector<double> flat;
        for (const auto& v : values) {
            flat.insert(flat.end(), v.begin(), v.end());
        }
        visit(prefix + what, flat);
        for (std::size_t k = 0; k < values.size(); ++k) {
            values[k] = Vec3(flat[3 * k], flat[3 * k + 1], flat[3 * k + 2]);
        }
    };
    field("position", position);
    field("velocity", velocity);
    std::vector<double> flat;
    for (const auto& s : plastic_states_) {
        flat.insert(flat.end(), s.inverse.data(), s.inverse.data() + 9);
        flat.push_back(s.strain);
    }
    visit(prefix + "plastic", flat);
    for (std::size_t k = 0; k < plastic_states_.size(); ++k) {
        std::copy_n(&flat[10 * k], 9, plastic_states_[k].inverse.data());
        plastic_states_[k].strain = flat[10 * k + 9];
    }
    visit(prefix + "across", across_);
    visit(prefix + "stress", stress_);
    visit(prefix + "plastic_work", plastic_);
    for (std::size_t k = 0; k < pressures.size(); ++k) {
        visit(prefix + "pressure_" + std::to_string(k), pressures[k].value);
    }
    for (std::size_t k = 0; k < holds.size(); ++k) {
        for (int c = 0; c < 3; ++c) {
            visit(prefix + "hold_" + std::to_string(k) + "_" + "xyz"[c], holds[k].velocity[c]);
        }
    }
}

} // namespace proveta
