// Clusters: rigid bodies made of overlapping spheres, which alone meet anything (thesis 2.7).
#pragma once

#include <vector>

#include "core/motion/rotation.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// The form of a cluster in its principal frame: centre of mass at the origin, axes along the principal axes of inertia.
struct ClusterShape {
    std::vector<Vec3> centre;    ///< of its spheres, m
    std::vector<double> radius;  ///< m
    double volume = 0.0;         ///< m3
    Vec3 inertia = Vec3::Zero(); ///< principal moments for a density of 1 kg/m3, m5
};

/// Bodies among the spheres of a model. Their spheres stand behind all others, one body's after another's. Velocities and momenta live half
/// a step behind the positions, as those of spheres do.
struct Clusters {
    std::size_t begin = 0;              ///< first sphere that belongs to a cluster, if there is any
    std::vector<std::uint32_t> first{}; ///< first sphere of each; one more than there are clusters, or none
    std::vector<Vec3> offset{};         ///< centre of sphere `begin + k` in its body's principal frame, m
    std::vector<double> mass{};         ///< kg
    std::vector<Vec3> position{};       ///< centres of mass, m
    std::vector<Vec3> start{};          ///< these at the start, m
    std::vector<Vec3> velocity{};       ///< m/s
    std::vector<rotation::State> turning{};

    [[nodiscard]] std::size_t size() const { return mass.size(); }
    [[nodiscard]] bool empty() const { return mass.empty(); }
    /// Number of spheres that belong to no cluster: the first ones.
    [[nodiscard]] std::size_t alone(const Spheres& spheres) const { return empty() ? spheres.size() : begin; }
    /// Which body a sphere belongs to; -1: none.
    [[nodiscard]] std::int32_t of(std::size_t sphere) const { return sphere < begin || empty() ? -1 : body_[sphere - begin]; }

    /// Appends a cluster at rest, and its spheres to the spheres, which then must be the last to come. density in kg/m3 of the whole body.
    /// The spheres carry the body's mass and its smallest principal moment, which their contacts' dashpots need.
    void add(Spheres& spheres, const ClusterShape& shape, double density, const Vec3& centre, const rotation::Quaternion& attitude,
             int material = 0);

    /// Appends a cluster of another set as it is, with its spheres.
    void append(Spheres& spheres, const Clusters& from, const Spheres& its, std::size_t body);

    /// Puts a body's spheres where the body is, and gives them the velocities that took them there in dt seconds; dt = 0: those of the
    /// body.
    void place(std::size_t body, double dt, Spheres& spheres) const;

    /// Calls visit as `Model::visit_state` does.
    template <class Visit> void visit_state(Visit&& visit);
    /// The same for which clusters there are and what they are, without where they are. Throws std::runtime_error when that is no set of
    /// clusters at the end of so many spheres.
    template <class Visit> void visit_members(std::size_t spheres, Visit&& visit);

  private:
    void open(const Spheres& spheres);
    void number(std::size_t spheres);
    std::vector<std::int32_t> body_; // of each sphere from `begin` on
};

template <class Visit> void Clusters::visit_members(std::size_t spheres, Visit&& visit) {
    std::vector<std::int32_t> begins(first.begin(), first.end());
    std::vector<double> flat;
    std::vector<double> arms;
    for (std::size_t k = 0; k < size(); ++k) {
        flat.push_back(mass[k]);
        flat.insert(flat.end(), start[k].begin(), start[k].end());
        flat.insert(flat.end(), turning[k].inertia.begin(), turning[k].inertia.end());
    }
    for (const Vec3& arm : offset) {
        arms.insert(arms.end(), arm.begin(), arm.end());
    }
    visit("cluster_first", begins);
    visit("cluster_members", flat);
    visit("cluster_offsets", arms);
    first.assign(begins.begin(), begins.end());
    const std::size_t n = flat.size() / 7;
    mass.resize(n);
    start.resize(n);
    position.resize(n, Vec3::Zero());
    velocity.resize(n, Vec3::Zero());
    turning.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
        const double* at = &flat[7 * k];
        mass[k] = at[0];
        start[k] = Vec3(at[1], at[2], at[3]);
        turning[k].inertia = Vec3(at[4], at[5], at[6]);
    }
    offset.resize(arms.size() / 3);
    for (std::size_t k = 0; k < offset.size(); ++k) {
        offset[k] = Vec3(arms[3 * k], arms[3 * k + 1], arms[3 * k + 2]);
    }
    number(spheres);
}

template <class Visit> void Clusters::visit_state(Visit&& visit) {
    std::vector<double> flat;
    for (std::size_t k = 0; k < size(); ++k) {
        for (const Vec3& v : {position[k], velocity[k], turning[k].momentum, turning[k].spin}) {
            flat.insert(flat.end(), v.begin(), v.end());
        }
        const auto& q = turning[k].attitude.coeffs();
        flat.insert(flat.end(), q.begin(), q.end());
    }
    visit("clusters", flat);
    for (std::size_t k = 0; k < size(); ++k) {
        const double* at = &flat[16 * k];
        position[k] = Vec3(at[0], at[1], at[2]);
        velocity[k] = Vec3(at[3], at[4], at[5]);
        turning[k].momentum = Vec3(at[6], at[7], at[8]);
        turning[k].spin = Vec3(at[9], at[10], at[11]);
        turning[k].attitude.coeffs() = Eigen::Vector4d(at[12], at[13], at[14], at[15]);
    }
}

} // namespace proveta
