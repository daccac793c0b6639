#include "lab/granular_results.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/angles.hpp"
#include "lab/axial_results.hpp"
#include "lab/derived.hpp"

namespace proveta {

namespace {

constexpr double window = 0.01; // half of the axial strain that a dilation is read over, so that single stones that slip do not count

// Secant friction angle of a cohesionless material, in degrees.
double friction_angle(double axial, double lateral) { return degrees * std::asin((axial - lateral) / (axial + lateral)); }

// sin psi = -r/(2 - r) with r the volumetric over the axial strain increment, compression positive, in degrees.
double dilation_angle(double ratio) { return degrees * std::asin(std::clamp(-ratio / (2.0 - ratio), -1.0, 1.0)); }

// Slope of the volumetric strain over the axial one about a row.
std::optional<double> volume_slope(const Loading& l, std::size_t row) {
    const auto first = std::lower_bound(l.strain.begin(), l.strain.end(), l.strain[row] - window) - l.strain.begin();
    const auto last = std::upper_bound(l.strain.begin(), l.strain.end(), l.strain[row] + window) - l.strain.begin() - 1;
    const auto line = fit(l.strain, l.volume, static_cast<std::size_t>(first), static_cast<std::size_t>(last));
    return line ? std::optional(line->slope) : std::nullopt;
}

// The steepest dilation of the loading, as a slope; rows whose window the loading does not fill are left out.
std::optional<double> steepest_dilation(const Loading& l) {
    std::optional<double> lowest;
    for (std::size_t k = 0; k < l.strain.size(); ++k) {
        if (l.strain[k] < window || l.strain[k] > l.strain.back() - window) {
            continue;
        }
        if (const auto slope = volume_slope(l, k); slope && (!lowest || *slope < *lowest)) {
            lowest = slope;
        }
    }
    return lowest;
}

// Mean over the rows of the last tenth of the axial strain.
double late_mean(const Loading& l, const std::vector<double>& y) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t k = 0; k < y.size(); ++k) {
        if (l.strain[k] >= 0.9 * l.strain.back()) {
            sum += y[k];
            count += 1.0;
        }
    }
    return sum / count;
}

// Pressure that the membrane's hoop tension adds at the girth: twice E t over D times the growth of the girth since it was put on.
double hoop_pressure(const MembraneInput& m, double girth_growth, double diameter) {
    return 2.0 * m.young_modulus * m.thickness * std::max(girth_growth, 0.0) / (diameter * (1.0 + girth_growth));
}

} // namespace

std::vector<report::Scalar> granular_results(const Measured& m, double pressure, const MembraneInput& membrane) {
    const Loading l = loading_of(m.curve, m.press.sense);
    std::vector<report::Scalar> out{
        {"confining_pressure", "Confining pressure", pressure, "Pa", "of the cell, on the membrane's outer face, held constant"}};
    if (l.deviator.empty()) {
        return out;
    }
    const auto girth = m.curve.values("membrane_girth_strain");
    const std::size_t peak = peak_index(l.deviator);
    const auto hoop = [&](std::size_t row) { return hoop_pressure(membrane, -girth[l.row[row]], m.shape.diameter); };
    const double at_peak = hoop(peak);
    const auto steepest = steepest_dilation(l);
    const auto slope_at_peak = volume_slope(l, peak);
    const auto line = line_between(l.strain, l.deviator, 0.05, 0.3);
    const auto half = x_at_share(l.strain, l.deviator, 0.5);
    const auto of = [](const std::optional<double>& slope) { return slope ? std::optional(dilation_angle(*slope)) : std::nullopt; };
    const double crossings = m.curve.values("membrane_crossings").back();
    const auto rate = m.curve.values("rate");
    double fastest = 0.0;
    for (const auto row : l.row) {
        fastest = std::max(fastest, std::fabs(rate[row]));
    }
    const char* shown = "at the largest deviator";
    out.insert(
        out.end(),
        {{"strength", "Strength, total axial stress", l.stress[peak], "Pa", shown},
         {"peak_deviatoric_stress", "Largest deviatoric stress", l.deviator[peak], "Pa", "axial stress less the confining pressure"},
         {"strain_at_peak", "Strain at the largest deviator", l.strain[peak], "",
          "platen travel over height since the axial loading began"},
         {"friction_angle", "Friction angle at peak", friction_angle(l.stress[peak], pressure), "deg",
          "sin phi = (s1 - s3)/(s1 + s3) at the largest deviator, without cohesion, s3 the confining pressure"},
         {"friction_angle_corrected", "Friction angle at peak, less the membrane", friction_angle(l.stress[peak], pressure + at_peak),
          "deg", "the same with s3 raised by the membrane's hoop tension"},
         {"membrane_pressure", "Pressure that the membrane adds at peak", at_peak, "Pa",
          "2 E t e / D at the girth, e its growth since the membrane was put on (Henkel and Gilbert 1952)"},
         {"friction_angle_late", "Friction angle at the end", friction_angle(late_mean(l, l.stress), pressure), "deg",
          "of the mean axial stress over the last tenth of the strain"},
         {"dilation_angle", "Largest dilation angle", of(steepest), "deg",
          "sin psi = -r/(2 - r), r the slope of volumetric over axial strain, over 2 % of axial strain"},
         {"dilation_angle_at_peak", "Dilation angle at peak", of(slope_at_peak), "deg", "the same about the largest deviator"},
         {"volumetric_strain_at_peak", "Volumetric strain at peak", l.volume[peak], "",
          "since the axial loading began, compaction positive"},
         {"volumetric_strain_at_end", "Volumetric strain at the end", l.volume.back(), "", "the same"},
         {"largest_compaction", "Largest compaction", *std::max_element(l.volume.begin(), l.volume.end()), "",
          "largest volumetric strain since the axial loading began"},
         {"initial_modulus", "Initial modulus", line ? std::optional(line->slope) : std::nullopt, "Pa",
          "slope of deviator over axial strain, 5 % to 30 % of the peak"},
         {"secant_modulus", "Secant modulus E50", half ? std::optional(0.5 * l.deviator[peak] / *half) : std::nullopt, "Pa",
          "half the largest deviator over its strain"},
         {"inertial_number", "Inertial number", fastest / m.press.length * m.grain * std::sqrt(m.density / pressure), "",
          "rate of axial strain times d sqrt(rho / p); below a thousandth flow counts as quasi-static"},
         {"membrane_leaks", "Particles through the membrane", crossings, "",
          "contacts whose particle's centre lay beyond it, over all steps"},
         {"largest_overlap", "Largest overlap", m.overlap, "",
          "of two spheres, or of a sphere and a platen or the membrane, over the smaller radius, at any step; beyond that of the bed"},
         {"work", "Work of the platens", m.energy.rows.back()[m.energy.column("platens")], "J", "to the end of the test"},
         {"friction_work", "Dissipated by sliding", m.energy.rows.back()[m.energy.column("friction")], "J", "to the end of the test"}});
    for (auto&& more : cycle_results(m.curve, m.press.sense)) {
        out.push_back(std::move(more));
    }
    return out;
}

} // namespace proveta
