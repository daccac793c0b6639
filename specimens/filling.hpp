// Particles fall into a rigid cylinder and are pressed until they rest.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "specimens/packing.hpp"
#include "specimens/stones.hpp"

namespace proveta {

/// One particle to come.
struct Grain {
    double size;   ///< diameter, of a stone that of the sphere of its volume, m
    int form = -1; ///< of the plan's forms; -1: a sphere
};

/// What is filled into which cylinder and how.
struct FillingPlan {
    double diameter = 0.0, height = 0.0; ///< of the cylinder, m
    std::vector<ClusterShape> forms;     ///< of size 1; none: all grains are spheres
    std::vector<Grain> grains;           ///< in the order in which they come
    bool level = true;                   ///< what comes to lie above the height is taken away
    double friction = 0.1;               ///< between grains; the cylinder is smooth
    double modulus = 100e6;              ///< Young's modulus of the grains, Pa
    double pressure = 10e3;              ///< of the top platen, Pa

    /// Radius of the sphere around a grain, m.
    [[nodiscard]] double reach(const Grain& grain) const {
        return grain.form < 0 ? 0.5 * grain.size : grain.size * reach_of(forms[static_cast<std::size_t>(grain.form)]);
    }
};

/// How it went.
struct FillingReport {
    std::size_t placed = 0;     ///< grains put in
    std::size_t taken_away = 0; ///< of these, above the height
    std::int64_t steps = 0;     ///< of the calculation
    double time = 0.0;          ///< that these cover, s
    double pressure = 0.0;      ///< of the top platen at the end, Pa
    double rms_speed = 0.0;     ///< of the grains at the end, m/s
};

/// A filled cylinder: its base on z = 0, its axis z.
struct Filling {
    double height = 0.0; ///< of the top platen, m
    std::vector<ClusterShape> forms;
    std::vector<Stone> stones;
    Packing spheres; ///< where grains are spheres
    FillingReport report;
};

/// Centres at which the spheres around the grains touch neither each other nor the cylinder: each grain in turn is let down at several
/// places at random and takes the lowest. Throws std::invalid_argument for a grain that is wider than the cylinder.
std::vector<Vec3> let_down(const FillingPlan& plan, std::uint64_t seed);

/// Grains of any attitude are let down, fall, are levelled, pressed to the pressure and left to rest. Throws NumericalFailure when they
/// come to no rest.
Filling fill(const FillingPlan& plan, std::uint64_t seed, const std::function<void(double)>& progress = {});

} // namespace proveta
