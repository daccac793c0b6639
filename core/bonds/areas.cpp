#include "core/bonds/areas.hpp"

#include <algorithm>
#include <array>
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

double contact_area(AreaRule rule, double r_i, double r_j, double weight_i, double weight_j) {
    if (rule == AreaRule::minimum_radius) {
        const double r = std::min(r_i, r_j);
        return pi * r * r;
    }
    return 0.5 * (weight_i + weight_j) * pi * r_i * r_j;
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
            reach[i] += 0.5 * (d + r_i - r_j);
            reach[j] += 0.5 * (d + r_j - r_i);
            for (const auto k : {i, j}) {
                cones[k] += pi * r_i * r_j;
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
            out.weight[k] = polyhedron_ratio(faces[k]) * 4.0 * pi * mean_reach * mean_reach / cones[k];
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
        out.pair.push_back(contact_area(rule, spheres.radius[i], spheres.radius[j], out.weight[i], out.weight[j]));
    }
    return out;
}

} // namespace proveta
