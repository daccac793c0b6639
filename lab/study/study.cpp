#include "lab/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lab/series/expand.hpp"
#include "lab/series/statistics.hpp"
#include "lab/study/extrapolation.hpp"

namespace proveta {

using input::Json;

namespace {

// How a kind of study varies a deck, and its words.
struct Variation {
    const char *section, *key;
    const char* title;   // of the study
    const char* axis;    // of plots
    const char* limit;   // of what is extrapolated
    double axis_factor;  // from x to the axis' unit
    const char* heading; // of the table's column
};

const Variation& variation(StudyKind kind) {
    static const Variation rate{"loading", "rate", "loading rate", "closing speed of the platens [m/s]", "at rate 0", 1.0, "rate_m/s"};
    static const Variation step{"numerics", "safety", "time step", "time step over the stable one", "at step 0", 1.0, "step_over_stable"};
    static const Variation size{"specimen", "spheres", "number of spheres", "spacing of the spheres (V/n)^(1/3) [mm]", "at size 0",
                                1e3,        "spheres"};
    return kind == StudyKind::rate ? rate : kind == StudyKind::step ? step : size;
}

double length_along_load(const Deck& deck) {
    const Shape shape =
        deck.specimen.file.empty() ? shape_of(deck.specimen) : obtain_specimen(deck.specimen, deck.folder, deck.source).shape;
    return deck.test == "brazilian" ? shape.lateral_size() : shape.height;
}

// Distance from sphere to sphere, on the mean, m.
double spacing(const Deck& deck) {
    const Shape shape = shape_of(deck.specimen);
    const double room = shape.volume() / static_cast<double>(deck.specimen.spheres);
    return shape.planar() ? std::sqrt(room) : std::cbrt(room);
}

// Values about the deck's own, from the coarsest to the finest.
std::vector<double> usual_values(StudyKind kind, const Deck& deck, const Json& json) {
    const auto multiples = [](double of, std::initializer_list<double> factors) {
        std::vector<double> out;
        for (const double f : factors) {
            out.push_back(of * f);
        }
        return out;
    };
    if (kind == StudyKind::size) {
        auto out = multiples(static_cast<double>(deck.specimen.spheres), {0.1, 0.25, 0.5, 1.0});
        std::transform(out.begin(), out.end(), out.begin(), [](double v) { return std::round(v); });
        return out;
    }
    if (kind == StudyKind::step) {
        return {0.9, 0.6, 0.3, 0.15};
    }
    const auto pointer = Json::json_pointer("/loading/rate");
    if (json.contains(pointer) && json[pointer].is_number()) {
        return multiples(json[pointer].get<double>(), {4.0, 2.0, 1.0, 0.5});
    }
    return multiples(length_along_load(deck), {2.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0, 1.0 / 12.0}); // a second
}

Json as_json(StudyKind kind, double value) {
    return kind == StudyKind::size ? Json(static_cast<std::int64_t>(std::llround(value))) : Json(value);
}

} // namespace

Study plan_study(const StudyRequest& request) {
    const Variation& varied = variation(request.kind);
    const std::string path = fmt::format("/{}/{}", varied.section, varied.key);
    Json base = input::load_json(request.deck);
    apply_settings(base, request.settings);
    input::Problems problems;
    if (has_lists(base) || base.contains("proveta_manifest") || base.contains("proveta_series_manifest")) {
        throw input::InputError({{request.deck, "", "a series or a manifest", "the deck of one test", "a study makes its own series"}});
    }
    const Deck own = read_deck(base, request.deck);
    if (!own.specimen.file.empty() && (request.kind == StudyKind::size || request.seeds > 1)) {
        problems.push_back({request.deck, "/specimen/file", "\"" + own.specimen.file + "\"", "a recipe, of which specimens can be made",
                            "a stored specimen has one size and one packing"});
    }
    const auto values = request.values.empty() ? usual_values(request.kind, own, resolved(own)) : request.values;
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (std::count(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(k), values[k]) > 0) {
            problems.push_back({"--values", "", fmt::format("{:.6g} twice", values[k]), "values that differ", ""});
        }
    }
    if (values.size() < 2) {
        problems.push_back({"--values", "", fmt::format("{} of them", values.size()), "at least two values to compare", ""});
    }
    Study study;
    study.kind = request.kind;
    study.plan.series = true;
    study.plan.title = fmt::format("{}: a study of the {}", own.title, varied.title);
    std::vector<MemberProblem> found;
    for (const double value : values) {
        for (int s = 0; s < request.seeds; ++s) {
            Json json = base;
            json[varied.section][varied.key] = as_json(request.kind, value);
            if (request.seeds > 1) {
                json["specimen"]["seed"] = own.specimen.seed + s;
            }
            try {
                Deck deck = read_deck(json, request.deck);
                study.values.push_back(value);
                study.x.push_back(request.kind == StudyKind::size ? spacing(deck) : value);
                const std::string name = fmt::format("{}_{:.6g}", varied.key, value);
                study.plan.members.push_back(
                    {request.seeds > 1 ? fmt::format("{}_seed_{}", name, deck.specimen.seed) : name, std::move(deck)});
            } catch (const input::InputError& error) {
                for (const auto& problem : error.problems) {
                    found.push_back({problem, {}});
                }
            }
        }
    }
    for (const auto& problem : merged(found)) {
        problems.push_back(problem);
    }
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
    return study;
}

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

// What people look at first.
bool is_main(const report::Scalar& s) {
    return s.name.ends_with("strength") || s.name == "young_modulus" || s.name == "poisson_ratio" || s.name == "strain_at_peak" ||
           s.name == "crack_energy";
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
    report::Scalar largest = trend.scalar;
    largest.value = *std::max_element(trend.y.begin(), trend.y.end());
    const report::Scalar shown = report::readable(largest);
    const double factor = *largest.value != 0.0 ? *shown.value / *largest.value : 1.0;
    report::Plot p{fmt::format("{} by {}; the line is the fit, its left end the limit.", trend.scalar.title, varied.title),
                   varied.axis,
                   fmt::format("{} [{}]", trend.scalar.title, shown.unit.empty() ? "-" : shown.unit),
                   {},
                   {}};
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
    out.tables.push_back(table_of(study, found));
    for (const auto& trend : found) {
        if (!is_main(trend.scalar)) {
            continue;
        }
        const auto& [name, title, ignored, unit, formula] = trend.scalar;
        if (trend.fit) {
            out.results.push_back(
                {name + "_limit", fmt::format("{} {}", title, varied.limit), trend.fit->limit, unit,
                 fmt::format("least squares of limit + c x^{:.2g} over {} tests, x: {}{}", trend.fit->power, trend.x.size(), varied.axis,
                             trend.fit->half_width ? fmt::format("; +- {:.3g} {} (95 %)", *trend.fit->half_width, unit) : "")});
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
