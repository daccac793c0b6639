#include "lab/calibrate/residual_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "lab/trials/uniform.hpp"

namespace proveta {

namespace {

constexpr int random_starts = 3000;
constexpr double ridge_linear = 1e-4;
constexpr double ridge_quadratic = 3e-2;

} // namespace

double chebyshev(const std::vector<double>& a, const std::vector<double>& b) {
    double d = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        d = std::max(d, std::fabs(a[k] - b[k]));
    }
    return d;
}

double SearchPoint::score() const { return std::sqrt(std::inner_product(deviation.begin(), deviation.end(), deviation.begin(), 0.0)); }

ResidualModel::ResidualModel(const std::vector<SearchPoint>& samples, std::vector<double> centre, double radius)
    : samples_(samples), centre_(std::move(centre)), radius_(radius) {
    const auto terms = features(centre_).size();
    const auto deviations = static_cast<Eigen::Index>(samples.front().deviation.size());
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(terms, terms);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(terms, deviations);
    double weights = 0.0;
    for (const auto& s : samples) {
        if (!s.complete) {
            continue;
        }
        const Eigen::VectorXd f = features(s.u);
        const double far = f.segment(1, static_cast<Eigen::Index>(centre_.size())).squaredNorm() / static_cast<double>(centre_.size());
        const double weight = 1.0 / ((1.0 + far) * (1.0 + far));
        const Eigen::Map<const Eigen::VectorXd> d(s.deviation.data(), deviations);
        normal += weight * f * f.transpose();
        right += weight * f * d.transpose();
        weights += weight;
    }
    for (Eigen::Index k = 1; k < terms; ++k) {
        normal(k, k) += weights * (k <= static_cast<Eigen::Index>(centre_.size()) ? ridge_linear : ridge_quadratic);
    }
    coefficients_ = normal.ldlt().solve(right);
}

Eigen::VectorXd ResidualModel::features(const std::vector<double>& u) const {
    const std::size_t n = centre_.size();
    Eigen::VectorXd f(static_cast<Eigen::Index>(1 + n + n * (n + 1) / 2));
    Eigen::Index at = 0;
    f[at++] = 1.0;
    for (std::size_t k = 0; k < n; ++k) {
        f[at++] = (u[k] - centre_[k]) / radius_;
    }
    for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = a; b < n; ++b) {
            f[at++] = f[static_cast<Eigen::Index>(1 + a)] * f[static_cast<Eigen::Index>(1 + b)];
        }
    }
    return f;
}

bool ResidualModel::promising(const std::vector<double>& u) const {
    double least = std::numeric_limits<double>::infinity();
    bool complete = true;
    for (const auto& s : samples_) {
        double square = 0.0;
        for (std::size_t k = 0; k < u.size(); ++k) {
            square += (u[k] - s.u[k]) * (u[k] - s.u[k]);
        }
        if (square < least) {
            least = square;
            complete = s.complete;
        }
    }
    return complete;
}

double ResidualModel::square(const std::vector<double>& u) const { return (coefficients_.transpose() * features(u)).squaredNorm(); }

std::vector<double> ResidualModel::best(double reach, std::uint64_t seed) const {
    std::mt19937_64 random(seed);
    std::vector<double> low;
    std::vector<double> high;
    for (const double c : centre_) {
        low.push_back(std::max(0.0, c - reach));
        high.push_back(std::min(1.0, c + reach));
    }
    std::vector<double> best = centre_;
    double least = square(best);
    std::vector<double> u = centre_;
    for (int k = 0; k < random_starts; ++k) {
        for (std::size_t d = 0; d < u.size(); ++d) {
            u[d] = std::lerp(low[d], high[d], uniform(random));
        }
        if (const double here = square(u); here < least && promising(u)) {
            least = here;
            best = u;
        }
    }
    // The best of them slides down along the axes with ever shorter steps.
    for (double step = 0.25 * reach; step > 1e-3 * reach; step *= 0.5) {
        for (bool moved = true; moved;) {
            moved = false;
            for (std::size_t d = 0; d < u.size(); ++d) {
                for (const double sign : {-1.0, 1.0}) {
                    u = best;
                    u[d] = std::clamp(u[d] + sign * step, low[d], high[d]);
                    if (const double here = square(u); here < least && promising(u)) {
                        least = here;
                        best = u;
                        moved = true;
                    }
                }
            }
        }
    }
    return best;
}

} // namespace proveta
