#include "lab/calibrate/target_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/input/column_heading.hpp"
#include "core/input/text_table.hpp"
#include "lab/calibrate/plausible.hpp"
#include "lab/derived.hpp"
#include "materials/measured.hpp"

namespace proveta {

namespace {

using input::Unit;

// A column in SI. key: "x" or "y" of the target's keys; by: its factor, of which the size may also come from the file's unit.
std::vector<double> column(const input::TextTable& table, std::size_t at, const std::string& quantity, double by, char key,
                           TargetCurve& out) {
    const auto& c = table.columns()[at];
    const Unit dimension = is_stress(quantity) ? Unit::pressure : Unit::none;
    double factor = by;
    if (!c.unit.empty()) {
        const auto unit = input::unit_factor(c.unit, dimension);
        if (!unit) {
            throw std::runtime_error(
                fmt::format("column \"{}\" has the unit {}, which is none of a {}", c.heading, c.unit, plain(quantity)));
        }
        const bool sign_alone = std::fabs(by) == 1.0;
        if (!sign_alone && std::fabs(std::fabs(by) / *unit - 1.0) > 1e-6) {
            throw std::runtime_error(fmt::format("column \"{}\" is in {}, a factor of {:.6g}, and {}_factor is {:.6g}: leave it out, or -1 "
                                                 "for the sign",
                                                 c.heading, c.unit, *unit, key, by));
        }
        factor = std::copysign(*unit, by);
    }
    const std::string unit = c.unit.empty() ? fmt::format("times {:.6g}", by) : "in " + c.unit;
    out.notes.push_back(
        fmt::format("read '{}' as {}, {}", c.heading.empty() ? fmt::format("column {}", at + 1) : c.heading, plain(quantity), unit));
    auto values = table.numbers(at);
    for (double& v : values) {
        v *= factor;
    }
    return values;
}

SampledCurve from_table(const TargetInput& t, TargetCurve& out) {
    const input::TextTable table(t.curve);
    std::vector<std::string> wrong;
    const auto find = [&](const std::string& column) {
        try {
            return table.find(column);
        } catch (const std::runtime_error& e) {
            wrong.emplace_back(e.what());
            return std::size_t{0};
        }
    };
    const std::size_t x = find(t.x_column);
    const std::size_t y = find(t.y_column);
    if (!wrong.empty()) {
        throw std::runtime_error(fmt::format("{}", fmt::join(wrong, "; ")));
    }
    SampledCurve all{column(table, x, t.x, t.x_factor, 'x', out), column(table, y, t.y, t.y_factor, 'y', out)};
    std::vector<std::string> unused;
    for (std::size_t c = 0; c < table.columns().size(); ++c) {
        if (c != x && c != y && !table.columns()[c].heading.empty()) {
            unused.push_back("'" + table.columns()[c].heading + "'");
        }
    }
    if (!unused.empty()) {
        out.notes.push_back(fmt::format("not used: {}", fmt::join(unused, ", ")));
    }
    return all;
}

// An experiment's file says itself what its columns are, and whether its stress is total or deviatoric.
SampledCurve from_experiment(const TargetInput& t, TargetCurve& out) {
    const MeasuredCurve m = load_measured_curve(t.curve);
    if (m.empty()) {
        throw std::runtime_error("an empty slot: its measured points have to be filled in first");
    }
    const auto values = [&](const std::string& name) {
        std::vector<double> v;
        for (std::size_t k = 0; k < m.axial_strain.size(); ++k) {
            const double more = name == "total_stress" && !m.total       ? m.confinement
                                : name == "deviatoric_stress" && m.total ? -m.confinement
                                                                         : 0.0;
            v.push_back(name == "axial_strain" || name == "gauge_strain" ? m.axial_strain[k]
                        : name == "circumferential_strain"               ? m.lateral_strain[k]
                        : name == "volumetric_strain"                    ? m.axial_strain[k] + 2.0 * m.lateral_strain[k]
                                                                         : m.axial_stress[k] + more);
        }
        return v;
    };
    out.notes.push_back(
        fmt::format("read as an experiment at {:.4g} MPa, {} stress", 1e-6 * m.confinement, m.total ? "total" : "deviatoric"));
    return {values(t.x), values(t.y)};
}

void take_off_toe(const TargetInput& t, TargetCurve& out) {
    if (t.toe != "removed") {
        return;
    }
    const auto line = line_between(out.measured.x, out.measured.y, 0.1, 1.0 / 3.0);
    if (!line || !(line->slope > 0.0)) {
        throw std::runtime_error("no straight part between 10 % and 33 % of the peak, from which the toe could be removed");
    }
    out.toe = -line->intercept / line->slope;
    for (double& x : out.measured.x) {
        x -= out.toe;
    }
    out.notes.push_back(fmt::format("toe of {:.4g} strain taken off", out.toe));
}

// Points by which x goes on beyond all before: what a test led by its platens can be compared with.
void take_compared(const TargetInput& t, double last, TargetCurve& out) {
    const auto& m = out.measured;
    double reached = -std::numeric_limits<double>::infinity();
    double back = 0.0; // farthest that x went back
    std::size_t left_out = 0;
    std::size_t beyond = 0;
    for (std::size_t k = 0; k < m.x.size(); ++k) {
        const bool counts = (!t.from.word.empty() || m.x[k] >= t.from.number) && (!t.to.word.empty() || m.x[k] <= t.to.number);
        if (!counts) {
            continue;
        }
        if (m.x[k] <= reached) {
            back = std::max(back, reached - m.x[k]);
            ++left_out;
            continue;
        }
        reached = m.x[k];
        if (m.x[k] > last) {
            ++beyond;
            continue;
        }
        out.compared.x.push_back(m.x[k]);
        out.compared.y.push_back(m.y[k]);
    }
    const std::size_t kept = out.compared.x.size();
    if (kept < 3) {
        throw std::runtime_error(fmt::format("{} points in the range that counts, at least 3 are wanted{}", kept,
                                             beyond > 0 ? fmt::format("; the test ends at {:.4g}", last) : ""));
    }
    const double range = out.compared.x.back() - out.compared.x.front();
    if (left_out > kept + beyond) {
        throw std::runtime_error(fmt::format("{} goes back in {} of {} rows: they are not in the order of measurement; sort them by {}",
                                             plain(t.x), left_out, m.x.size(), plain(t.x)));
    }
    if (left_out > 0 && back > 1e-3 * range) {
        out.warnings.push_back(fmt::format("{} rows in which {} goes back (by {:.3g} at most: unloading, or snap-back) are not compared: "
                                           "the test goes on in it",
                                           left_out, plain(t.x), back));
    }
    if (beyond > 0) {
        out.warnings.push_back(fmt::format("the test ends at {} = {:.4g}, the curve at {:.4g}: {} of its points are not compared; raise "
                                           "loading.stop.axial_strain to compare all",
                                           t.x, last, reached, beyond));
    }
}

} // namespace

TargetCurve load_target_curve(const TargetInput& t, const std::string& test, double last, double young) {
    TargetCurve out;
    const bool experiment = is_measured_curve(t.curve);
    const SampledCurve all = experiment ? from_experiment(t, out) : from_table(t, out);
    std::size_t missing = 0;
    for (std::size_t k = 0; k < all.x.size(); ++k) {
        if (std::isfinite(all.x[k]) && std::isfinite(all.y[k])) {
            out.measured.x.push_back(all.x[k] - t.x_offset);
            out.measured.y.push_back(all.y[k]);
        } else {
            ++missing;
        }
    }
    if (missing > 0) {
        out.warnings.push_back(fmt::format("{} of {} rows lack a value and were left out", missing, all.x.size()));
    }
    if (out.measured.x.size() < 3) {
        throw std::runtime_error(fmt::format("{} rows with both values, at least 3 are wanted", out.measured.x.size()));
    }
    std::size_t backwards = 0;
    for (std::size_t k = 1; k < out.measured.x.size(); ++k) {
        backwards += out.measured.x[k] < out.measured.x[k - 1] ? 1 : 0;
    }
    if (2 * backwards > out.measured.x.size() && out.measured.x.back() < out.measured.x.front()) {
        std::reverse(out.measured.x.begin(), out.measured.x.end());
        std::reverse(out.measured.y.begin(), out.measured.y.end());
        out.notes.push_back("rows from the last to the first");
    }
    if (std::all_of(out.measured.y.begin(), out.measured.y.end(), [](double v) { return v == 0.0; })) {
        throw std::runtime_error("all values are 0");
    }
    if (t.y.empty()) {
        return out; // said where it is missing
    }
    if (const std::string doubt = check_plausible(out.measured, t, test, young); !doubt.empty()) {
        out.warnings.push_back(doubt);
    }
    take_off_toe(t, out);
    take_compared(t, last, out);
    return out;
}

} // namespace proveta
