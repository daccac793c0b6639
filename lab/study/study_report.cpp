// What a study's tests say together: trends, their limits, tables and plots.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lab/series/statistics.hpp"
#include "lab/study/extrapolation.hpp"
#include "lab/study/variation.hpp"

namespace proveta {

namespace {

// A result over the study.
struct Trend {
    report::Scalar scalar;       // name, title, unit, formula
    std::vector<double> x, y;    // of the members that have it
    std::map<double, Sample> at; // by x, ascending
    std::optional<Extrapolation> fit;
};

std::vector<Trend> trends(const Study& study, const std::vector<MemberResult>& members) {
    std::vector<Trend> out;
    for (const auto& m : members) {
        for (const auto& scalar : m.results) {
            if (std::none_of(out.begin(), out.end(), [&](const Trend& t) { return t.scalar.name == scalar.name; })) {
                out.push_back({scalar, {}, {}, {}, {}});
            }
        }
    }
    for (auto& trend : out) {
        std::map<double, std::vector<double>> by;
        for (std::size_t k = 0; k < members.size(); ++k) {
            const auto value = members[k].complete() ? members[k].value(trend.scalar.name) : std::nullopt;
            if (value) {
                trend.x.push_back(study.x[k]);
                trend.y.push_back(*value);
                by[study.x[k]].push_back(*value);
            }
        }
        for (const auto& [x, values] : by) {
            trend.at[x] = sample_of(values);
        }
        trend.fit = extrapolate(trend.x, trend.y);
    }
    std::erase_if(out, [](const Trend& t) { return t.at.size() < 2; });
    return out;
}

// A value of a result with its unit.
std::string in_words(report::Scalar scalar, double value) {
    scalar.value = value;
    const report::Scalar shown = report::readable(scalar);
    return report::three_digits(*shown.value) + (shown.unit.empty() ? "" : " " + shown.unit);
}

// What people look at first.
bool is_main(const report::Scalar& s) {
    return s.name.ends_with("strength") || s.name == "young_modulus" || s.name == "poisson_ratio" || s.name == "strain_at_peak" ||
           s.name == "crack_energy";
}

// As `table_of`, to be read: titles, units that people use, three digits.
report::TextTable page_table(const Study& study, const std::vector<Trend>& found) {
    const Variation& varied = variation(study.kind);
    report::TextTable t{fmt::format("Results by {}; \u00b1 is the 95 % confidence of a mean", varied.title), {{"Result", "Unit"}}};
    std::map<double, double, std::greater<>> columns; // value by x, coarse to fine
    for (std::size_t k = 0; k < study.x.size(); ++k) {
        columns[study.x[k]] = study.values[k];
    }
    for (const auto& [x, value] : columns) {
        t.rows.front().push_back(fmt::format("{:.6g}{}", value, varied.unit));
    }
    t.rows.front().insert(t.rows.front().end(), {"Limit", "Power"});
    for (const auto& trend : found) {
        const report::InUnit shown(trend.scalar, trend.y);
        const auto with_error = [&](double value, const std::optional<double>& half_width) {
            return shown.text(value) + (half_width ? " \u00b1 " + shown.text(*half_width) : "");
        };
        std::vector<std::string> row{trend.scalar.title, shown.unit};
        for (const auto& [x, value] : columns) {
            const auto at = trend.at.find(x);
            row.push_back(
                at == trend.at.end()
                    ? ""
                    : with_error(at->second.mean, at->second.spread ? std::optional(at->second.spread->half_width) : std::nullopt));
        }
        row.push_back(trend.fit ? with_error(trend.fit->limit, trend.fit->half_width) : "");
        row.push_back(trend.fit ? report::three_digits(trend.fit->power) : "");
        t.rows.push_back(std::move(row));
    }
    return t;
}

report::TextTable table_of(const Study& study, const std::vector<Trend>& found) {
    report::TextTable t{"Results by " + std::string(variation(study.kind).title) + ", SI units", {{"result", "unit"}}};
    std::map<double, double, std::greater<>> columns; // value by x, coarse to fine
    for (std::size_t k = 0; k < study.x.size(); ++k) {
        columns[study.x[k]] = study.values[k];
    }
    for (const auto& [x, value] : columns) {
        t.rows.front().push_back(fmt::format("{} {:.6g}", variation(study.kind).heading, value));
        t.rows.front().push_back("+-95%");
    }
    t.rows.front().insert(t.rows.front().end(), {"limit", "+-95%", "power"});
    for (const auto& trend : found) {
        std::vector<std::string> row{trend.scalar.name, trend.scalar.unit};
        for (const auto& [x, value] : columns) {
            const auto at = trend.at.find(x);
            row.push_back(at == trend.at.end() ? "" : fmt::format("{:.6g}", at->second.mean));
            row.push_back(at == trend.at.end() || !at->second.spread ? "" : fmt::format("{:.3g}", at->second.spread->half_width));
        }
        row.push_back(trend.fit ? fmt::format("{:.6g}", trend.fit->limit) : "");
        row.push_back(trend.fit && trend.fit->half_width ? fmt::format("{:.3g}", *trend.fit->half_width) : "");
        row.push_back(trend.fit ? fmt::format("{:.3g}", trend.fit->power) : "");
        t.rows.push_back(std::move(row));
    }
    return t;
}

report::Plot plot_of(const Study& study, const Trend& trend) {
    const Variation& varied = variation(study.kind);
    const report::InUnit shown(trend.scalar, trend.y);
    const double factor = shown.factor;
    report::Plot p{fmt::format("{} by {}; the line is the fit, its left end the limit.", trend.scalar.title, varied.title),
                   varied.axis,
                   fmt::format("{} [{}]", trend.scalar.title, shown.unit.empty() ? "-" : shown.unit),
                   {},
                   {}};
    p.y_from_zero = false; // a trend is small beside the result itself
    report::Curve points{"tests", {}, {}, "#1f4e79", report::CurveStyle::points};
    for (std::size_t k = 0; k < trend.x.size(); ++k) {
        points.x.push_back(varied.axis_factor * trend.x[k]);
        points.y.push_back(factor * trend.y[k]);
    }
    p.curves.push_back(points);
    report::Curve means{"mean", {}, {}, "#1e7b46", report::CurveStyle::dashed};
    for (const auto& [x, sample] : trend.at) {
        means.x.push_back(varied.axis_factor * x);
        means.y.push_back(factor * sample.mean);
    }
    p.curves.push_back(means);
    if (trend.fit) {
        report::Curve line{fmt::format("limit + c x^{:.2g}", trend.fit->power), {}, {}, "#c0392b"};
        const double far = trend.at.rbegin()->first;
        for (int k = 0; k <= 50; ++k) {
            const double x = far * k / 50.0;
            line.x.push_back(varied.axis_factor * x);
            line.y.push_back(factor * (trend.fit->limit + trend.fit->slope * std::pow(x, trend.fit->power)));
        }
        p.marks.emplace_back(0.0, factor * trend.fit->limit);
        p.curves.push_back(line);
    }
    return p;
}

} // namespace

SeriesExtra evaluate_study(const Study& study, const std::vector<MemberResult>& members) {
    const Variation& varied = variation(study.kind);
    const auto found = trends(study, members);
    SeriesExtra out;
    out.csv_name = "study.csv";
    out.csv = table_of(study, found);
    out.tables.push_back(page_table(study, found));
    for (const auto& trend : found) {
        if (!is_main(trend.scalar)) {
            continue;
        }
        const auto& [name, title, ignored, unit, formula] = trend.scalar;
        if (trend.fit) {
            out.results.push_back(
                {name + "_limit", fmt::format("{} {}", title, varied.limit), trend.fit->limit, unit,
                 fmt::format("least squares of limit + c x^{:.2g} over {} tests, x: {}{}", trend.fit->power, trend.x.size(), varied.axis,
                             trend.fit->half_width ? "; \u00b1 " + in_words(trend.scalar, *trend.fit->half_width) + " (95 %)" : "")});
            out.key_figures.push_back(report::key_figure(out.results.back()));
            const double finest = trend.at.begin()->second.mean;
            out.results.push_back({name + "_left", fmt::format("{}: finest over limit, less 1", title),
                                   trend.fit->limit != 0.0 ? std::optional(finest / trend.fit->limit - 1.0) : std::nullopt, "",
                                   "mean at the smallest x over the limit"});
        }
        const auto second = std::next(trend.at.begin());
        const double before = second->second.mean;
        out.results.push_back({name + "_change", fmt::format("{}: change at the last refinement", title),
                               before != 0.0 ? std::optional(trend.at.begin()->second.mean / before - 1.0) : std::nullopt, "",
                               "mean at the smallest x over the mean at the next, less 1"});
        out.plots.push_back(plot_of(study, trend));
    }
    if (found.empty()) {
        out.warnings.emplace_back("Fewer than two values of the study have results: there is no trend.");
    }
    return out;
}

} // namespace proveta
