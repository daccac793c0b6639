#include "lab/series/strength_envelope.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "lab/derived.hpp"

namespace proveta {

namespace {

constexpr const char* too_few = "fewer than two distinct confining pressures";

double largest_strength(const std::vector<StrengthPoint>& points) {
    double most = 0.0;
    for (const auto& p : points) {
        most = std::max({most, std::fabs(p.sigma_1), std::fabs(p.sigma_3)});
    }
    return most;
}

// Pressures closer than this count as one: between them scatter decides, not pressure.
double same_pressure(const std::vector<StrengthPoint>& points) { return 1e-3 * largest_strength(points); }

bool has_two_pressures(const std::vector<StrengthPoint>& points) {
    if (points.empty()) {
        return false;
    }
    const auto [low, high] = std::minmax_element(points.begin(), points.end(), [](auto a, auto b) { return a.sigma_3 < b.sigma_3; });
    return high->sigma_3 - low->sigma_3 > same_pressure(points);
}

template <class Criterion> double squared_residuals(const std::vector<StrengthPoint>& points, const Criterion& criterion) {
    double sum = 0.0;
    for (const auto& p : points) {
        const double r = p.sigma_1 - criterion.sigma_1(p.sigma_3);
        sum += r * r;
    }
    return sum;
}

double explained(const std::vector<StrengthPoint>& points, double squared_residuals) {
    double mean = 0.0;
    for (const auto& p : points) {
        mean += p.sigma_1 / static_cast<double>(points.size());
    }
    double total = 0.0;
    for (const auto& p : points) {
        total += (p.sigma_1 - mean) * (p.sigma_1 - mean);
    }
    return total > 0.0 ? 1.0 - squared_residuals / total : 0.0;
}

// Hoek and Brown's criterion as (sigma_1 - sigma_3)^2 = A + B sigma_3, with A = sigma_ci^2 and B = m_i sigma_ci: one root instead of a
// quotient under a root, so that Gauss-Newton needs few steps. In units of the largest strength.
class HoekBrownFit {
  public:
    explicit HoekBrownFit(const std::vector<StrengthPoint>& points) : unit_(largest_strength(points)) {
        const auto n = static_cast<Eigen::Index>(points.size());
        sigma_3_.resize(n);
        deviator_.resize(n);
        for (Eigen::Index k = 0; k < n; ++k) {
            const auto& p = points[static_cast<std::size_t>(k)];
            sigma_3_[k] = p.sigma_3 / unit_;
            deviator_[k] = (p.sigma_1 - p.sigma_3) / unit_;
        }
    }

    // True when the steps have become as small as rounding.
    bool run() {
        start();
        double misfit = misfit_of(ab_);
        for (int step = 0; step < 200; ++step) {
            const Eigen::VectorXd f = (ab_[0] + ab_[1] * sigma_3_.array()).sqrt().matrix();
            Eigen::MatrixX2d slopes(f.size(), 2);
            slopes.col(0) = 0.5 / f.array();
            slopes.col(1) = 0.5 * sigma_3_.array() / f.array();
            Eigen::Vector2d change = slopes.colPivHouseholderQr().solve(deviator_ - f);
            if (change.norm() <= 1e-14 * ab_.norm()) {
                return true;
            }
            while (misfit_of(ab_ + change) > misfit && change.norm() > 1e-14 * ab_.norm()) {
                change *= 0.5; // too far, or out of the root's domain
            }
            const double better = misfit_of(ab_ + change);
            if (!(better < misfit)) {
                return true; // no direction goes down any more
            }
            ab_ += change;
            misfit = better;
        }
        return false;
    }

    [[nodiscard]] double a() const { return ab_[0] * unit_ * unit_; }
    [[nodiscard]] double b() const { return ab_[1] * unit_; }

  private:
    // The line of the squared deviators, lifted where it leaves a point without a root.
    void start() {
        Eigen::MatrixX2d line(sigma_3_.size(), 2);
        line.col(0).setOnes();
        line.col(1) = sigma_3_;
        const Eigen::VectorXd squares = deviator_.array().square().matrix();
        ab_ = line.colPivHouseholderQr().solve(squares);
        const double lowest = (line * ab_).minCoeff();
        const double least = 1e-2 * squares.mean();
        ab_[0] += lowest < least ? least - lowest : 0.0;
    }

    [[nodiscard]] double misfit_of(const Eigen::Vector2d& ab) const {
        const Eigen::ArrayXd squares = ab[0] + ab[1] * sigma_3_.array();
        return squares.minCoeff() > 0.0 ? (deviator_.array() - squares.sqrt()).square().sum() : std::numeric_limits<double>::infinity();
    }

    double unit_;
    Eigen::VectorXd sigma_3_, deviator_;
    Eigen::Vector2d ab_{0.0, 0.0};
};

} // namespace

double StrengthLine::friction_angle() const { return 2.0 * std::atan(std::sqrt(slope)) - 0.5 * std::numbers::pi; }

double StrengthLine::cohesion() const { return 0.5 * intercept / std::sqrt(slope); }

Outcome<MohrCoulomb> fit_mohr_coulomb(const std::vector<StrengthPoint>& points) {
    std::vector<StrengthPoint> used;
    std::copy_if(points.begin(), points.end(), std::back_inserter(used),
                 [none = same_pressure(points)](const auto& p) { return p.sigma_3 > -none; });
    if (!has_two_pressures(used)) {
        return {std::nullopt, too_few};
    }
    std::vector<double> x;
    std::vector<double> y;
    for (const auto& p : used) {
        x.push_back(p.sigma_3);
        y.push_back(p.sigma_1);
    }
    const auto line = fit(x, y, 0, x.size() - 1);
    if (!line || line->slope <= 1.0) {
        return {std::nullopt, "strength grows no faster than confining pressure (K <= 1)"};
    }
    MohrCoulomb found{{line->slope, line->intercept}, 0.0, {}, {}};
    const double residuals = squared_residuals(used, found.line);
    found.r2 = explained(used, residuals);
    const auto n = static_cast<double>(used.size());
    if (used.size() >= 3) {
        double mean = 0.0;
        for (const double v : x) {
            mean += v / n;
        }
        double spread = 0.0;
        for (const double v : x) {
            spread += (v - mean) * (v - mean);
        }
        const double variance = residuals / (n - 2.0);
        const double kk = variance / spread;
        const double pp = variance * (1.0 / n + mean * mean / spread);
        const double kp = -variance * mean / spread;
        const double k = found.line.slope;
        // d phi / dK and the gradient of c = P / (2 sqrt K)
        const double dphi = 1.0 / (std::sqrt(k) * (1.0 + k));
        const double dcp = 0.5 / std::sqrt(k);
        const double dck = -0.5 * found.line.cohesion() / k;
        found.friction_angle_error = dphi * std::sqrt(kk);
        found.cohesion_error = std::sqrt(std::max(0.0, dcp * dcp * pp + 2.0 * dcp * dck * kp + dck * dck * kk));
    }
    return {found, ""};
}

double HoekBrown::sigma_1(double sigma_3) const { return sigma_3 + sigma_ci * std::sqrt(std::max(0.0, m_i * sigma_3 / sigma_ci + 1.0)); }

double HoekBrown::tensile_strength() const {
    // 2 / (sqrt(m^2 + 4) + m) is (sqrt(m^2 + 4) - m) / 2 without the difference of near numbers.
    return 2.0 * sigma_ci / (std::sqrt(m_i * m_i + 4.0) + m_i);
}

Outcome<HoekBrown> fit_hoek_brown(const std::vector<StrengthPoint>& points) {
    if (!has_two_pressures(points)) {
        return {std::nullopt, too_few};
    }
    HoekBrownFit search(points);
    if (!search.run()) {
        return {std::nullopt, "the least-squares search did not settle"};
    }
    if (search.a() <= 0.0) {
        return {std::nullopt, "strength grows faster with confining pressure than the criterion allows (sigma_ci^2 <= 0)"};
    }
    if (search.b() <= 0.0) {
        return {std::nullopt, "the deviator does not grow with confining pressure (m_i <= 0)"};
    }
    HoekBrown found{std::sqrt(search.a()), search.b() / std::sqrt(search.a()), 0.0};
    found.r2 = explained(points, squared_residuals(points, found));
    return {found, ""};
}

StrengthLine thesis_line(double tau_f, double mu_s) {
    const double t = mu_s + std::sqrt(1.0 + mu_s * mu_s); // tan(pi/4 + phi/2) with tan(phi) = mu_s
    return {t * t, 2.0 * tau_f * t};
}

double attard_setunge(double fc, double p) {
    constexpr double mega = 1e6;
    const double strength = fc / mega;
    const double tensile = 0.9 * 0.32 * std::pow(strength, 0.67);
    const double exponent = 1.25 * (1.0 + 0.062 * p / fc) * std::pow(strength, -0.21);
    return fc * std::pow(p / mega / tensile + 1.0, exponent);
}

StrengthEnvelope strength_envelope(std::vector<StrengthPoint> points) {
    auto line = fit_mohr_coulomb(points);
    auto curve = fit_hoek_brown(points);
    return {std::move(points), std::move(line), std::move(curve), {}, {}};
}

} // namespace proveta
