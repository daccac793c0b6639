#include "core/bonds/areas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace proveta {

using std::numbers::pi;

double polyhedron_ratio(double faces) {
    constexpr std::array<double, 5> count{4, 6, 8, 12, 20};
    constexpr std::array<double, 5> ratio{3.30797, 1.90986, 1.65399, 1.32503, 1.20657};
    if (faces <= count.front()) {
        return ratio.front();
    }
    if (faces >= count.back()) {
        return 1.0 + 0.20657 * 20.0 / faces;
    }
    const auto above = static_cast<std::size_t>(std::upper_bound(count.begin(), count.end(), faces) - count.begin());
    const double t = (faces - count[above - 1]) / (count[above] - count[above - 1]);
    return ratio[above - 1] + t * (ratio[above] - ratio[above - 1]);
}

double polygon_ratio(double sides) {
    const double n = std::max(sides, 3.0);
    return n * std::tan(pi / n) / pi;
}

double raw_area(AreaRule rule, const Spheres& spheres, std::size_t i, std::size_t j) {
    const double r_i = spheres.radius[i];
    const double r_j = spheres.radius[j];
    if (rule == AreaRule::minimum_radius) {
        return spheres.section(r_i < r_j ? i : j);
    }
    if (!spheres.planar) {
        return pi * r_i * r_j;
    }
    const double x = (r_j - r_i) / r_i; // the quotient loses its digits where the radii are nearly equal
    return 2.0 * r_i * (std::fabs(x) < 1e-4 ? 1.0 + 0.5 * x - x * x / 12.0 : x / std::log1p(x));
}

double contact_area(AreaRule rule, const Spheres& spheres, std::size_t i, std::size_t j, double weight_i, double weight_j) {
    return 0.5 * (weight_i + weight_j) * raw_area(rule, spheres, i, j);
}

Areas effective_areas(AreaRule rule, const Spheres& spheres, const std::vector<Pair>& pairs, const std::vector<std::uint8_t>& skin) {
    const std::size_t n = spheres.size();
    Areas out;
    out.weight.assign(n, 1.0);
    if (rule == AreaRule::virtual_polyhedron) {
        std::vector<double> reach(n, 0.0);
        std::vector<double> cones(n, 0.0);
        std::vector<int> faces(n, 0);
        for (const auto& [a, b] : pairs) {
            const auto i = static_cast<std::size_t>(a);
            const auto j = static_cast<std::size_t>(b);
            const double d = (spheres.position.at(j) - spheres.position.at(i)).norm();
            const double r_i = spheres.radius[i];
            const double r_j = spheres.radius[j];
            const double cone = raw_area(rule, spheres, i, j);
            reach[i] += 0.5 * (d + r_i - r_j);
            reach[j] += 0.5 * (d + r_j - r_i);
            for (const auto k : {i, j}) {
                cones[k] += cone;
                ++faces[k];
            }
        }
        double sum = 0.0;
        double count = 0.0;
        for (std::size_t k = 0; k < n; ++k) {
            if (faces[k] == 0) {
                continue;
            }
            const double mean_reach = reach[k] / faces[k];
            const double surface = spheres.planar ? polygon_ratio(faces[k]) * 2.0 * pi * mean_reach
                                                  : polyhedron_ratio(faces[k]) * 4.0 * pi * mean_reach * mean_reach;
            out.weight[k] = surface / cones[k];
            if (!skin[k]) {
                sum += out.weight[k];
                count += 1.0;
            }
        }
        if (count > 0.0) {
            const double interior = sum / count;
            for (std::size_t k = 0; k < n; ++k) {
                if (skin[k] || faces[k] == 0) {
                    out.weight[k] = interior;
                }
            }
        }
    }
    out.pair.reserve(pairs.size());
    for (const auto& [a, b] : pairs) {
        const auto i = static_cast<std::size_t>(a);
        const auto j = static_cast<std::size_t>(b);
        out.pair.push_back(contact_area(rule, spheres, i, j, out.weight[i], out.weight[j]));
    }
    return out;
}

} // namespace proveta
