// The page of a series.
#include "lab/series/series_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/citation.hpp"
#include "lab/progress.hpp"

namespace proveta {

namespace {

constexpr std::size_t most_named = 10; // curves of a plot that a key can still tell apart

using report::InUnit;

report::TextTable member_table(const SeriesResults& r) {
    report::TextTable t{"Tests", {{"Test", "Kind", "Status", "Ended by", "Wall time"}}};
    const auto badges = all_badges(r.members);
    t.rows.front().insert(t.rows.front().end(), badges.begin(), badges.end());
    for (const auto& m : r.members) {
        std::vector<std::string> row{m.member->name, m.member->deck.test, m.status, m.stopped_by,
                                     m.seconds > 0.0 ? Progress::duration(m.seconds) : ""};
        for (const auto& name : badges) {
            const auto badge = std::find_if(m.badges.begin(), m.badges.end(), [&](const auto& b) { return b.name == name; });
            row.push_back(badge == m.badges.end() ? "" : badge->good ? "good" : badge->verdict.substr(0, badge->verdict.find(':')));
        }
        t.rows.push_back(std::move(row));
        t.links.push_back(m.badges.empty() ? "" : m.member->name + "/report.html");
    }
    return t;
}

report::TextTable results_table(const SeriesResults& r) {
    report::TextTable t{"Results of the tests", {{"Result", "Unit"}}};
    for (const auto& m : r.members) {
        t.rows.front().push_back(m.member->name);
    }
    for (const auto& scalar : all_results(r.members)) {
        std::vector<double> values;
        for (const auto& m : r.members) {
            if (const auto value = m.value(scalar.name)) {
                values.push_back(*value);
            }
        }
        if (values.empty()) {
            continue; // every test's own report says so
        }
        const InUnit shown(scalar, values);
        std::vector<std::string> row{scalar.title, shown.unit};
        for (const auto& m : r.members) {
            const auto value = m.value(scalar.name);
            row.push_back(value ? shown.text(*value) : "");
        }
        t.rows.push_back(std::move(row));
    }
    return t;
}

report::TextTable formula_table(const SeriesResults& r) {
    report::TextTable t{"How the tests' results are found", {{"Result", "How it is found"}}};
    for (const auto& scalar : all_results(r.members)) {
        t.rows.push_back({scalar.title, scalar.formula});
    }
    return t;
}

report::TextTable statistics_table(const SeedGroup& group) {
    report::TextTable t{fmt::format("{}: {} specimens that differ in their seed", group.name, group.members.size()),
                        {{"Result", "Unit", "n", "Mean", "Deviation", "Variation [%]", "95 % of the mean, \u00b1", "Least", "Most"}}};
    for (const auto& [scalar, sample] : group.statistics) {
        if (sample.n == 0) {
            t.rows.push_back({scalar.title, scalar.unit, "0"});
            continue;
        }
        const auto& spread = sample.spread;
        const InUnit shown(scalar, {spread ? std::max(std::fabs(spread->least), std::fabs(spread->most)) : sample.mean});
        std::vector<std::string> row{scalar.title, shown.unit, std::to_string(sample.n), shown.text(sample.mean)};
        if (spread) {
            row.insert(row.end(),
                       {shown.text(spread->deviation),
                        spread->variation && report::has_ratios(scalar.name) ? report::three_digits(100.0 * *spread->variation) : "",
                        shown.text(spread->half_width), shown.text(spread->least), shown.text(spread->most)});
        }
        t.rows.push_back(std::move(row));
    }
    return t;
}

// Which colour and name the curve of member k has: each its own, or, where there are too many, those of its group.
std::pair<std::size_t, std::string> legend_of(const SeriesResults& r, std::size_t k) {
    if (r.members.size() <= most_named) {
        return {k, r.members[k].member->name};
    }
    std::size_t colour = 0;
    for (std::size_t j = 0; j < k; ++j) { // singles and groups before this one
        const auto first = [&](const SeedGroup& g) {
            return g.members.front() != j && std::find(g.members.begin(), g.members.end(), j) != g.members.end();
        };
        colour += std::none_of(r.groups.begin(), r.groups.end(), first) ? 1 : 0;
    }
    for (const auto& group : r.groups) {
        if (group.members.front() == k) {
            return {colour, fmt::format("{} ({} specimens)", group.name, group.members.size())};
        }
        if (std::find(group.members.begin(), group.members.end(), k) != group.members.end()) {
            return {legend_of(r, group.members.front()).first, ""};
        }
    }
    return {colour, r.members[k].member->name};
}

// The main curves of all members; those with the same axes share a plot.
std::vector<report::Plot> combined_plots(const SeriesResults& r) {
    std::vector<report::Plot> out;
    for (std::size_t k = 0; k < r.members.size(); ++k) {
        const auto& curve = r.members[k].curve;
        if (!curve || curve->values.x.empty()) {
            continue;
        }
        const PlotAxes& axes = curve->axes;
        auto plot = std::find_if(out.begin(), out.end(),
                                 [&](const report::Plot& p) { return p.x_title == axes.x_title && p.y_title == axes.y_title; });
        if (plot == out.end()) {
            plot = out.insert(
                out.end(),
                {"Main curves of the tests: " + axes.y_title + " over " + axes.x_title + ".", axes.x_title, axes.y_title, {}, {}});
        }
        const auto [colour, name] = legend_of(r, k);
        report::Curve drawn{name, curve->values.x, curve->values.y};
        report::tell_apart(drawn, colour);
        for (double& v : drawn.x) {
            v *= axes.x_factor;
        }
        for (double& v : drawn.y) {
            v *= axes.y_factor;
        }
        plot->curves.push_back(std::move(drawn));
    }
    return out;
}

// Of the first group of seeds, with its scatter, or of a strength envelope; else of the tests one by one.
std::vector<report::KeyFigure> first_figures(const SeriesResults& r) {
    constexpr std::size_t most = 4;
    auto out = report::key_figures(r.scalars, {"cohesion", "friction_angle", "sigma_ci", "m_i", "compressive_to_splitting"}, most);
    const std::vector<std::string> usual{"friction_angle",   "strength",      "splitting_strength",
                                         "tensile_strength", "young_modulus", "poisson_ratio"};
    for (const auto& group : r.groups) {
        for (const auto& name : usual) {
            const auto at =
                std::find_if(group.statistics.begin(), group.statistics.end(), [&](const auto& s) { return s.scalar.name == name; });
            if (at != group.statistics.end() && at->scalar.value && at->sample.spread && out.size() < most) {
                report::KeyFigure figure = report::key_figure(at->scalar);
                const InUnit shown(at->scalar, {at->sample.mean});
                figure.note = fmt::format("{}: mean of {}, \u00b1 {:.2g} (95 %)", group.name, at->sample.n,
                                          at->sample.spread->half_width * shown.factor);
                out.push_back(std::move(figure));
            }
        }
    }
    for (const auto& m : r.members) {
        for (auto& figure : report::key_figures(m.results, usual, 1)) {
            if (out.size() < most && r.groups.empty()) {
                figure.note = m.member->name;
                out.push_back(std::move(figure));
            }
        }
    }
    return out;
}

// A warning without its figures.
std::string wording(const std::string& warning) {
    std::string out;
    for (const char c : warning) {
        const bool figure = (c >= '0' && c <= '9') || c == '.';
        if (!figure || out.empty() || out.back() != '#') {
            out += figure ? '#' : c;
        }
    }
    return out;
}

// Every warning once, with the members that have it; those that differ in their figures only stand together.
std::vector<std::string> warnings_of(const SeriesResults& r) {
    struct Found {
        std::string text;
        std::vector<std::string> with;  // these figures
        std::vector<std::string> other; // others
    };
    std::vector<Found> found;
    std::size_t run = 0;
    for (const auto& m : r.members) {
        run += m.warnings.empty() && m.status == "not run" ? 0 : 1;
        for (const auto& w : m.warnings) {
            auto at = std::find_if(found.begin(), found.end(), [&](const Found& f) { return wording(f.text) == wording(w); });
            if (at == found.end()) {
                at = found.insert(found.end(), {w, {}, {}});
            }
            (at->text == w ? at->with : at->other).push_back(m.member->name);
        }
    }
    std::vector<std::string> out;
    if (r.status == "interrupted") {
        out.emplace_back("This series is partial: it was interrupted.");
    }
    for (const auto& [text, with, other] : found) {
        out.push_back(with.size() == run && run > 1 ? text + " (all tests)"
                      : other.empty()
                          ? fmt::format("{} ({})", text, fmt::join(with, ", "))
                          : fmt::format("{} ({}; with other figures {})", text, fmt::join(with, ", "),
                                        with.size() + other.size() == run ? "all other tests" : fmt::format("{}", fmt::join(other, ", "))));
    }
    for (const auto& group : r.groups) {
        if (!group.mean) {
            out.push_back(fmt::format("{}: no mean curve, because {}.", group.name, group.mean.reason));
        }
    }
    return out;
}

} // namespace

std::vector<report::Scalar> all_results(const std::vector<MemberResult>& members) {
    std::vector<report::Scalar> out;
    for (const auto& m : members) {
        for (const auto& scalar : m.results) {
            if (std::none_of(out.begin(), out.end(), [&](const auto& s) { return s.name == scalar.name; })) {
                out.push_back(scalar);
            }
        }
    }
    return out;
}

std::vector<std::string> all_badges(const std::vector<MemberResult>& members) {
    std::vector<std::string> out;
    for (const auto& m : members) {
        for (const auto& badge : m.badges) {
            if (std::find(out.begin(), out.end(), badge.name) == out.end()) {
                out.push_back(badge.name);
            }
        }
    }
    return out;
}

SeriesResults evaluate(std::vector<MemberResult> members) {
    SeriesResults r;
    const auto any = [&](const char* status) {
        return std::any_of(members.begin(), members.end(), [&](const auto& m) { return m.status == status; });
    };
    r.status = any("interrupted") || any("not run") ? "interrupted" : any("failed") ? "failed" : "complete";
    r.members = std::move(members);
    r.groups = seed_groups(r.members);
    r.envelope = envelope_of(r.members);
    if (r.envelope) {
        r.scalars = envelope_results(*r.envelope);
    }
    for (auto& ratio : strength_ratios(r.members)) {
        r.scalars.push_back(std::move(ratio));
    }
    return r;
}

std::string mean_curve_file(const SeedGroup& group) { return "mean_curves/" + group.name + ".csv"; }

std::string ending(const SeriesResults& r) {
    std::vector<std::string> parts;
    for (const char* status : {"complete", "failed", "interrupted", "not run"}) {
        const auto n = std::count_if(r.members.begin(), r.members.end(), [&](const auto& m) { return m.status == status; });
        if (n > 0) {
            parts.push_back(fmt::format("{} {}", n, status));
        }
    }
    return fmt::format("{} {}: {}", r.members.size(), r.members.size() == 1 ? "test" : "tests", fmt::join(parts, ", "));
}

report::Record series_record(const Plan& plan, const SeriesResults& r) {
    report::Record record;
    record.title = plan.title;
    std::vector<std::string> materials;
    for (const auto& m : plan.members) {
        const std::string& name = m.deck.material.values.name;
        if (std::find(materials.begin(), materials.end(), name) == materials.end()) {
            materials.push_back(name);
        }
    }
    record.subtitle = fmt::format("{}", fmt::join(materials, ", "));
    record.status = r.status;
    record.stopped_by = ending(r);
    record.warnings = warnings_of(r);
    record.key_figures = first_figures(r);
    input::Json decks = input::Json::array();
    for (const auto& m : plan.members) {
        decks.push_back(resolved(m.deck));
    }
    record.citation = citation("Series", plan.title, decks);
    record.overview = {member_table(r)};
    record.results = r.scalars;
    record.plots = combined_plots(r);
    if (r.envelope) {
        record.plots.push_back(strength_plot(*r.envelope));
        record.plots.push_back(mohr_plot(*r.envelope));
    }
    for (const auto& group : r.groups) {
        if (group.mean) {
            PlotAxes axes = group.of->axes;
            axes.title = fmt::format("{}: mean of {} specimens, {}.", group.name, group.curves.size(), mean_curve_file(group));
            record.plots.push_back(mean_curve_plot(*group.mean, group.curves, axes));
        }
    }
    record.tables = {results_table(r)};
    for (const auto& group : r.groups) {
        if (!group.statistics.empty()) {
            record.tables.push_back(statistics_table(group));
        }
    }
    record.tables.push_back(formula_table(r));
    return record;
}

} // namespace proveta
