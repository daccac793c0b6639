// Strength over confining pressure: what a series of tests at several pressures says of a material.
//
// sigma_3 is the confining pressure and sigma_1 the peak of the total axial stress, both in Pa, compression positive. A tension test is the
// point sigma_3 = -tensile strength, sigma_1 = 0: there the axis pulls and the free sides are the major stress.
#pragma once

#include <optional>
#include <vector>

#include "lab/series/outcome.hpp"
#include "reports/record/record.hpp"

namespace proveta {

/// The outcome of one test.
struct StrengthPoint {
    double sigma_3; ///< confining pressure, Pa
    double sigma_1; ///< peak total axial stress, Pa
};

/// Mohr-Coulomb's criterion as a line sigma_1 = P + K sigma_3.
struct StrengthLine {
    double slope = 1.0;     ///< K = tan^2(pi/4 + phi/2)
    double intercept = 0.0; ///< P = 2 c tan(pi/4 + phi/2), Pa

    [[nodiscard]] double sigma_1(double sigma_3) const { return intercept + slope * sigma_3; }
    [[nodiscard]] double friction_angle() const; ///< phi = 2 atan(sqrt K) - pi/2, rad
    [[nodiscard]] double cohesion() const;       ///< c = P / (2 sqrt K), Pa
};

/// A line through measured strengths. Errors are standard errors, by first-order propagation from those of K and P and their covariance.
struct MohrCoulomb {
    StrengthLine line;
    double r2 = 0.0;                            ///< share of the variance of sigma_1 that the line explains
    std::optional<double> friction_angle_error; ///< rad; empty with two points
    std::optional<double> cohesion_error;       ///< Pa; the same
};

/// Fit by least squares in sigma_1. Points in tension are left out: the criterion does not hold there and would take its slope from them.
/// None with fewer than two distinct pressures or when K <= 1, which no friction angle gives. Pressures within a thousandth of the largest
/// strength count as the same, here and below, so that a servo's last digits make neither a slope nor a tension test.
Outcome<MohrCoulomb> fit_mohr_coulomb(const std::vector<StrengthPoint>& points);

/// Hoek and Brown's criterion of intact material, sigma_1 = sigma_3 + sigma_ci (m_i sigma_3 / sigma_ci + s)^a with s = 1, a = 1/2
/// (J. Geotech. Eng. Div. 106 (1980) 1013; J. Rock Mech. Geotech. Eng. 11 (2019) 445).
struct HoekBrown {
    double sigma_ci = 0.0; ///< unconfined strength, Pa
    double m_i = 0.0;      ///< how fast strength grows with pressure
    double r2 = 0.0;       ///< share of the variance of sigma_1 that the curve explains

    [[nodiscard]] double sigma_1(double sigma_3) const; ///< Pa; sigma_3 itself below the apex -sigma_ci / m_i
    /// Uniaxial tensile strength of the criterion, the -sigma_3 of sigma_1 = 0, Pa: sigma_ci (sqrt(m_i^2 + 4) - m_i) / 2.
    [[nodiscard]] double tensile_strength() const;
};

/// Fit by nonlinear least squares in sigma_1, points in tension included; begins with the line of (sigma_1 - sigma_3)^2 over sigma_3, which
/// Hoek and Brown fit themselves but which weighs strong points more. None with fewer than two distinct pressures, or when strength does
/// not grow with pressure or grows so fast that sigma_ci^2 < 0.
Outcome<HoekBrown> fit_hoek_brown(const std::vector<StrengthPoint>& points);

/// The line that (5.22) of the thesis expects of a card: mu_s = tan(phi), c = tau_f, in Pa. It takes the strengths of a bond for those of
/// the material and is an estimate: with table 5.5 (16 MPa, 0.9) it says P = 71.9 MPa where 32.8 MPa were measured.
StrengthLine thesis_line(double tau_f, double mu_s);

/// Estimate of the confined strength of concrete, Pa, for unconfined strength fc and pressure p >= 0 in Pa (M. M. Attard, S. Setunge, ACI
/// Mater. J. 93 (1996) 432): fc (p/ft + 1)^k, k = 1.25 (1 + 0.062 p/fc) fc^-0.21, ft = 0.9 0.32 fc^0.67 with fc in MPa. Fitted to moderate
/// confinement: beyond about 20 MPa it is an extrapolation. The constants are as others quote them, not checked against the paper.
double attard_setunge(double fc, double p);

/// All that is said of a series. The first three come from the points; `thesis` is for who knows the card, `fc` for who tests concrete.
struct StrengthEnvelope {
    std::vector<StrengthPoint> points;
    Outcome<MohrCoulomb> mohr_coulomb;
    Outcome<HoekBrown> hoek_brown;
    std::optional<StrengthLine> thesis; ///< (5.22)
    std::optional<double> fc;           ///< unconfined strength for Attard and Setunge's estimate, Pa
};

StrengthEnvelope strength_envelope(std::vector<StrengthPoint> points);

/// c, phi, sigma_ci, m_i and the tensile strength that follows, with errors and r^2; those that could not be found say why in `formula`.
std::vector<report::Scalar> envelope_results(const StrengthEnvelope& envelope);

/// Half circle of Mohr of a state of stress, without a name, MPa.
report::Curve mohr_circle(const StrengthPoint& point);

/// Half circles of Mohr, one a point, with both fits: shear over normal stress, MPa, equal scales.
report::Plot mohr_plot(const StrengthEnvelope& envelope);

/// sigma_1 over sigma_3, MPa: the points, both fits, and dashed the estimates.
report::Plot strength_plot(const StrengthEnvelope& envelope);

} // namespace proveta
