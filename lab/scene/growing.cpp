#include "lab/scene/growing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "specimens/packing.hpp"

namespace proveta {

namespace {

constexpr double aim = 0.2 * most_grown_overlap;
constexpr double fewer = 0.95; // of the particles, at every further try

// As many as `count` of the radii, evenly from the whole list.
std::vector<std::size_t> some_of(std::size_t all, std::size_t count) {
    std::vector<std::size_t> out(count);
    for (std::size_t k = 0; k < count; ++k) {
        out[k] = k * all / count;
    }
    return out;
}

} // namespace

double filled_share(const Eigen::AlignedBox3d& box, const std::vector<double>& radii) {
    double volume = 0.0;
    for (const double r : radii) {
        volume += 4.0 / 3.0 * std::numbers::pi * r * r * r;
    }
    return volume / box.volume();
}

Grown grow_in(const Eigen::AlignedBox3d& box, const std::vector<double>& radii, std::uint64_t seed) {
    Shape shape;
    shape.kind = ShapeKind::prism;
    shape.width = box.sizes().x();
    shape.depth = box.sizes().y();
    shape.height = box.sizes().z();
    const Vec3 shift(box.center().x(), box.center().y(), box.min().z());
    constexpr double tolerance = 0.005; // of the net forces, where spheres are jammed
    const auto all = static_cast<double>(radii.size());
    for (double count = all * std::min(1.0, densest_share / filled_share(box, radii)); count >= 1.0; count *= fewer) {
        const auto chosen = some_of(radii.size(), static_cast<std::size_t>(count));
        std::vector<double> some;
        for (const auto k : chosen) {
            some.push_back(radii[k]);
        }
        Relaxation report;
        const Packing packing = pack(shape, some, seed, tolerance, report, {}, aim);
        if (report.largest_overlap <= most_grown_overlap) {
            Grown out;
            for (std::size_t k = 0; k < some.size(); ++k) {
                out.centre.emplace_back(packing.centre.at(k) + shift);
                out.number.push_back(chosen[report.number[k]]);
            }
            return out;
        }
    }
    return {};
}

} // namespace proveta
