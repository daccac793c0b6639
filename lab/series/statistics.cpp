#include "lab/series/statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace proveta {

namespace {

// Roots of I_x(nu/2, 1/2) = 0.05, x = nu / (nu + t^2), I the regularised incomplete beta function, found with 40 digits.
constexpr std::array<double, 30> t95{12.7062047361747,  4.302652729749464, 3.18244630528371,  2.776445105197794, 2.570581835636316,
                                     2.44691185114497,  2.364624251592785, 2.306004135204167, 2.262157162798206, 2.228138851986275,
                                     2.20098516009164,  2.178812829667229, 2.160368656462793, 2.144786687917804, 2.131449545559776,
                                     2.119905299221255, 2.109815577833317, 2.100922040241038, 2.09302405440831,  2.085963447265865,
                                     2.07961384472768,  2.073873067904026, 2.068657610419049, 2.063898561628026, 2.059538552753298,
                                     2.055529438642873, 2.051830516480286, 2.048407141795245, 2.045229642132704, 2.042272456301238};

} // namespace

double student_t95(std::size_t degrees_of_freedom) {
    if (degrees_of_freedom == 0) {
        return std::numeric_limits<double>::infinity();
    }
    if (degrees_of_freedom <= t95.size()) {
        return t95[degrees_of_freedom - 1];
    }
    constexpr double z = 1.95996398454005424;
    constexpr double z2 = z * z;
    constexpr double first = z * (z2 + 1.0) / 4.0;
    constexpr double second = z * ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0;
    const auto nu = static_cast<double>(degrees_of_freedom);
    return z + (first + second / nu) / nu;
}

Sample sample_of(const std::vector<double>& values) {
    Sample s{values.size(), 0.0, {}};
    if (values.empty()) {
        return s;
    }
    const auto n = static_cast<double>(s.n);
    for (const double v : values) {
        s.mean += v / n;
    }
    if (s.n < 2) {
        return s;
    }
    double squares = 0.0;
    for (const double v : values) {
        squares += (v - s.mean) * (v - s.mean);
    }
    const double deviation = std::sqrt(squares / (n - 1.0));
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    s.spread = Spread{deviation, s.mean != 0.0 ? std::optional(deviation / std::fabs(s.mean)) : std::nullopt,
                      student_t95(s.n - 1) * deviation / std::sqrt(n), *least, *most};
    return s;
}

} // namespace proveta
