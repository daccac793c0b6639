// The outcome of a series as JSON, CSV and text.
#include <fmt/format.h>

#include <algorithm>

#include "lab/series/series_report.hpp"

namespace proveta {

using input::Json;

namespace {

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json with_unit(const report::Scalar& s) { return {{"value", or_null(s.value)}, {"unit", s.unit}, {"formula", s.formula}}; }

Json member_json(const MemberResult& m) {
    Json j = {{"name", m.member->name},     {"test", m.member->deck.test}, {"seed", m.member->deck.specimen.seed},
              {"status", m.status},         {"stopped_by", m.stopped_by},  {"results", Json::object()},
              {"verdicts", Json::object()}, {"warnings", m.warnings}};
    for (const auto& s : m.results) {
        j["results"][s.name] = {{"value", or_null(s.value)}, {"unit", s.unit}};
    }
    for (const auto& b : m.badges) {
        j["verdicts"][b.name] = {{"good", b.good}, {"verdict", b.verdict}};
    }
    return j;
}

Json group_json(const SeedGroup& group, const SeriesResults& r) {
    Json j = {{"name", group.name}, {"members", Json::array()}, {"statistics", Json::object()}};
    for (const std::size_t k : group.members) {
        j["members"].push_back(r.members[k].member->name);
    }
    for (const auto& [scalar, sample] : group.statistics) {
        Json one = {{"n", sample.n}, {"mean", or_null(scalar.value)}, {"unit", scalar.unit}};
        if (const auto& spread = sample.spread) {
            one["deviation"] = spread->deviation;
            one["variation"] = or_null(spread->variation);
            one["half_width_95"] = spread->half_width;
            one["least"] = spread->least;
            one["most"] = spread->most;
        }
        j["statistics"][scalar.name] = one;
    }
    j["mean_curve"] = group.mean ? Json(mean_curve_file(group)) : Json();
    return j;
}

// "Quasi-static loading" as a column: "quasi_static_loading".
std::string as_heading(std::string text) {
    for (char& c : text) {
        c = c == ' ' || c == '-' ? '_' : static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    }
    return text;
}

} // namespace

Json series_summary(const report::Record& record, const SeriesResults& r) {
    Json j;
    j["title"] = record.title;
    j["status"] = r.status;
    j["stopped_by"] = record.stopped_by;
    j["results"] = Json::object();
    for (const auto& s : r.scalars) {
        j["results"][s.name] = with_unit(s);
    }
    for (const auto& m : r.members) {
        j["members"].push_back(member_json(m));
    }
    j["groups"] = Json::array();
    for (const auto& group : r.groups) {
        j["groups"].push_back(group_json(group, r));
    }
    j["warnings"] = record.warnings;
    return j;
}

report::TextTable series_table(const SeriesResults& r) {
    constexpr const char* pressure = "confining_pressure";
    const auto badges = all_badges(r.members);
    std::vector<report::Scalar> results = all_results(r.members);
    std::erase_if(results, [&](const auto& s) { return s.name == pressure; });
    report::TextTable t;
    t.title = "One row a test, SI units; the folder is relative to this file. Empty: the test has no such result or could not find it.";
    std::vector<std::string> heading{"folder", "test", "confining_pressure_Pa", "seed", "status"};
    for (const auto& badge : badges) {
        heading.push_back(as_heading(badge));
    }
    for (const auto& s : results) {
        heading.push_back(report::Column{s.name, s.unit, ""}.heading());
    }
    t.rows.push_back(std::move(heading));
    const auto number = [](const std::optional<double>& value) { return value ? fmt::format("{:.17g}", *value) : std::string(); };
    for (const auto& m : r.members) {
        std::vector<std::string> row{m.member->name, m.member->deck.test, number(m.value(pressure)),
                                     std::to_string(m.member->deck.specimen.seed), m.status};
        for (const auto& name : badges) {
            const auto badge = std::find_if(m.badges.begin(), m.badges.end(), [&](const auto& b) { return b.name == name; });
            row.push_back(badge == m.badges.end() ? "" : badge->good ? "good" : "not good");
        }
        for (const auto& s : results) {
            row.push_back(number(m.value(s.name)));
        }
        t.rows.push_back(std::move(row));
    }
    return t;
}

std::string series_text(const report::Record& record, const SeriesResults& r) {
    std::string out = fmt::format("{} ({}): {}\n", record.title, r.status, record.stopped_by);
    const auto line = [](const report::Scalar& scalar) {
        const auto shown = report::readable(scalar);
        return shown.value ? fmt::format("{:<28} {:>10.5g} {}", shown.title, *shown.value, shown.unit)
                           : fmt::format("{:<28} not determined", shown.title);
    };
    for (const auto& m : r.members) {
        out += fmt::format("  {} ({}): {}\n", m.member->name, m.status, m.stopped_by);
        for (const auto& s : m.results) {
            if (s.value && (s.name.ends_with("strength") || s.name == "young_modulus")) {
                out += fmt::format("    {}\n", line(s));
            }
        }
    }
    for (const auto& s : r.scalars) {
        out += fmt::format("  {}\n", line(s));
    }
    for (const auto& group : r.groups) {
        for (const auto& [scalar, sample] : group.statistics) {
            if (sample.spread && scalar.name.ends_with("strength")) {
                const double factor = *report::readable(scalar).value / *scalar.value;
                out += fmt::format("  {}: {} +- {:.3g} (95 %, {} specimens)\n", group.name, line(scalar),
                                   factor * sample.spread->half_width, sample.n);
            }
        }
    }
    for (const auto& w : record.warnings) {
        out += fmt::format("  warning: {}\n", w);
    }
    return out;
}

} // namespace proveta
