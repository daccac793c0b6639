#include "specimens/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "core/contacts/cell_grid.hpp"

namespace proveta {

namespace {

// m.
std::vector<double> particle_radii(const Specimen& s) {
    if (s.stones.empty()) {
        return s.spheres.radius;
    }
    std::vector<double> r;
    r.reserve(s.stones.size());
    for (const auto& stone : s.stones) {
        r.push_back(0.5 * stone.size);
    }
    return r;
}

void describe_sizes(const Specimen& s, SpecimenStatistics& out) {
    const auto r = particle_radii(s);
    const auto n = static_cast<double>(r.size());
    double sum = 0.0;
    double squares = 0.0;
    double volume = 0.0;
    for (const double x : r) {
        sum += x;
        squares += x * x;
        volume += s.shape.planar() ? std::numbers::pi * x * x : 4.0 / 3.0 * std::numbers::pi * x * x * x;
    }
    out.mean_radius = sum / n;
    out.relative_deviation = std::sqrt(std::max(0.0, squares / n - out.mean_radius * out.mean_radius)) / out.mean_radius;
    out.smallest_radius = *std::min_element(r.begin(), r.end());
    out.largest_radius = *std::max_element(r.begin(), r.end());
    out.porosity = 1.0 - volume / s.shape.volume();
}

void describe_surface(const Specimen& s, const Packing& spheres, SpecimenStatistics& out) {
    for (std::size_t k = 0; k < spheres.radius.size(); ++k) {
        const Vec3 p = spheres.centre.at(k);
        const double r = spheres.radius[k];
        out.outside += s.shape.depth_below_surface(p) < r * (1.0 - 1e-3) ? 1 : 0;
        out.on_lower_end += p.z() <= 1.1 * r ? 1 : 0;
        out.on_upper_end += s.shape.height - p.z() <= 1.1 * r ? 1 : 0;
    }
}

// Two stones that touch at several places are neighbours once; the fabric counts every contact.
void describe_contacts(const Specimen& s, const SpheresInSpace& all, SpecimenStatistics& out) {
    const auto& r = all.spheres.radius;
    const auto& centre = all.spheres.centre;
    Mat3 fabric = Mat3::Zero();
    std::size_t contacts = 0;
    std::set<std::pair<std::int32_t, std::int32_t>> neighbours;
    for (const auto& [a, b] : find_pairs(centre, r, 1.0, 0.0)) {
        const auto i = static_cast<std::size_t>(a);
        const auto j = static_cast<std::size_t>(b);
        if (all.particle[i] == all.particle[j]) {
            continue;
        }
        neighbours.insert(std::minmax(all.particle[i], all.particle[j]));
        ++contacts;
        const Vec3 to = centre.at(j) - centre.at(i);
        const double d = to.norm();
        out.largest_overlap = std::max(out.largest_overlap, (r[i] + r[j] - d) / std::min(r[i], r[j]));
        if (d > 0.0) {
            fabric += to * to.transpose() / (d * d);
        }
    }
    out.touching = 2.0 * static_cast<double>(neighbours.size()) / static_cast<double>(s.size());
    if (contacts > 0) {
        fabric /= static_cast<double>(contacts);
        const Mat3 isotropic = s.shape.planar() ? Mat3(Vec3(0.5, 0.0, 0.5).asDiagonal()) : Mat3(Mat3::Identity() / 3.0);
        out.fabric_deviator = std::sqrt((s.shape.planar() ? 2.0 : 1.5) * (fabric - isotropic).squaredNorm());
    }
}

} // namespace

SpecimenStatistics statistics(const Specimen& s) {
    SpecimenStatistics out;
    const SpheresInSpace all = spheres_in_space(s);
    out.spheres = all.spheres.radius.size();
    out.stones = s.stones.size();
    describe_sizes(s, out);
    describe_surface(s, all.spheres, out);
    describe_contacts(s, all, out);
    return out;
}

std::vector<std::uint8_t> skin_spheres(const Specimen& s) {
    std::vector<std::uint8_t> skin(s.spheres.radius.size());
    for (std::size_t k = 0; k < skin.size(); ++k) {
        skin[k] = s.shape.depth_below_surface(s.spheres.centre.at(k)) < 1.2 * s.spheres.radius[k] ? 1 : 0;
    }
    return skin;
}

Partition partition(const Shape& shape, const Spheres& spheres, const Bonds& bonds) {
    // Averaging over cuts at every height between low and high is an integral: each bond counts with the length of its part between
    // them, A |n_z| times |dz| over the height.
    const double low = 0.1 * shape.height;
    const double high = 0.9 * shape.height;
    constexpr double inner = 0.6;
    const Shape::Region core = shape.inner(inner, 0.8);
    Partition out;
    for (std::size_t b = 0; b < bonds.size(); ++b) {
        const Vec3 i = spheres.position.at(static_cast<std::size_t>(bonds.i[b]));
        const Vec3 j = spheres.position.at(static_cast<std::size_t>(bonds.j[b]));
        const Vec3 to = j - i;
        const double d = to.norm();
        const double bottom = std::min(i.z(), j.z());
        const double top = std::max(i.z(), j.z());
        const double between = std::max(0.0, std::min(top, high) - std::max(bottom, low));
        const double along = std::fabs(to.z()) / d;
        out.section += bonds.area[b] * along * between;
        out.interior += bonds.area[b] * along * core.fraction_inside(i, j) * std::fabs(to.z());
        out.filling += bonds.area[b] * d;
    }
    out.section /= (high - low) * shape.section();
    out.interior /= core.volume();
    out.filling /= shape.volume();
    return out;
}

} // namespace proveta
