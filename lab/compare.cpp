#include "lab/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "core/input/json.hpp"
#include "core/input/suggest.hpp"
#include "lab/trials/csv.hpp"

namespace proveta {

namespace fs = std::filesystem;
using input::Json;

namespace {

StoredResult read_result(const std::string& folder, const std::string& name, const Json& manifest) {
    StoredResult out;
    out.name = name;
    out.folder = folder;
    out.test = manifest.contains("deck") ? input::text_at(manifest["deck"], "test") : "";
    const Json summary = input::load_json((fs::path(folder) / "summary.json").string());
    out.status = input::text_at(summary, "status");
    if (summary.contains("results") && summary["results"].is_object()) {
        for (const auto& [key, found] : summary["results"].items()) {
            std::optional<double> value;
            if (found.is_object() && found.contains("value") && found["value"].is_number()) {
                value = found["value"].get<double>();
            }
            out.results.push_back({key, key, value, input::text_at(found, "unit"), input::text_at(found, "formula")});
        }
    }
    if (summary.contains("warnings") && summary["warnings"].is_array()) {
        for (const auto& warning : summary["warnings"]) {
            out.warnings.push_back(warning.is_string() ? warning.get<std::string>() : warning.dump());
        }
    }
    out.curve = read_csv((fs::path(folder) / "curve.csv").string());
    out.energy = read_csv((fs::path(folder) / "energy.csv").string());
    return out;
}

// How a column's numbers are shown, by the unit at the end of its name; strains have none.
struct ShownColumn {
    std::string title;
    double factor;
};

ShownColumn shown_column(const std::string& column) {
    std::string words = column;
    std::string unit;
    double factor = 1.0;
    for (const auto& [ending, name, by] :
         {std::tuple{"_Pa", "MPa", 1e-6}, {"_N", "kN", 1e-3}, {"_m/s", "m/s", 1.0}, {"_J", "J", 1.0}, {"_s", "s", 1.0}}) {
        if (words.ends_with(ending)) {
            words.resize(words.size() - std::string(ending).size());
            unit = name;
            factor = by;
            break;
        }
    }
    if (words.ends_with("strain") || words.find("strain_") != std::string::npos) {
        unit = "%";
        factor = 100.0;
    }
    std::replace(words.begin(), words.end(), '_', ' ');
    return {unit.empty() ? words : fmt::format("{} [{}]", words, unit), factor};
}

// A column by its heading, or by its name without unit.
const report::Table* table_with(const StoredResult& test, const std::string& name, std::string& heading) {
    for (const report::Table* table : {&test.curve, &test.energy}) {
        for (const auto& column : table->columns) {
            const bool plus_unit = column.name.starts_with(name + "_") && column.name.find('_', name.size() + 1) == std::string::npos;
            if (column.name == name || plus_unit) {
                heading = column.name;
                return table;
            }
        }
    }
    return nullptr;
}

// Names of results in the order of the first test that has each.
std::vector<std::string> result_names(const std::vector<StoredResult>& tests) {
    std::vector<std::string> names;
    for (const auto& test : tests) {
        for (const auto& result : test.results) {
            if (std::find(names.begin(), names.end(), result.name) == names.end()) {
                names.push_back(result.name);
            }
        }
    }
    return names;
}

const report::Scalar* find(const StoredResult& test, const std::string& name) {
    const auto at = std::find_if(test.results.begin(), test.results.end(), [&](const auto& r) { return r.name == name; });
    return at == test.results.end() ? nullptr : &*at;
}

} // namespace

std::vector<StoredResult> read_results(const std::vector<std::string>& folders) {
    std::vector<StoredResult> out;
    input::Problems problems;
    const auto one = [&](const std::string& folder, const std::string& name, const Json& manifest) {
        try {
            out.push_back(read_result(folder, name, manifest));
        } catch (const input::InputError& e) {
            problems.insert(problems.end(), e.problems.begin(), e.problems.end());
        } catch (const std::exception& e) {
            problems.push_back({folder, "", e.what(), "the result folder of a test", ""});
        }
    };
    for (const auto& folder : folders) {
        const fs::path path = fs::path(folder).lexically_normal();
        const std::string name = (path.has_filename() ? path.filename() : path.parent_path().filename()).string();
        try {
            const Json manifest = input::load_json((path / "manifest.json").string());
            if (manifest.contains("proveta_series_manifest") && manifest.contains("members") && manifest["members"].is_array()) {
                for (const auto& member : manifest["members"]) {
                    const std::string of = input::text_at(member, "name");
                    if (!of.empty() && of == fs::path(of).filename()) {
                        one((path / of).string(), name + "/" + of, member);
                    }
                }
            } else if (manifest.contains("proveta_manifest")) {
                one(path.string(), name, manifest);
            } else {
                problems.push_back({folder, "", "the result of something else", "the result folder of a test or a series", ""});
            }
        } catch (const input::InputError& e) {
            problems.insert(problems.end(), e.problems.begin(), e.problems.end());
        }
    }
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
    // Folders of one name are told apart by their whole paths.
    std::map<std::string, int> times;
    for (const auto& test : out) {
        ++times[test.name];
    }
    for (auto& test : out) {
        test.name = times[test.name] > 1 ? test.folder : test.name;
    }
    return out;
}

std::optional<double> difference(const report::Scalar& first, const report::Scalar& other) {
    if (!first.value || !other.value || *first.value == 0.0) {
        return std::nullopt;
    }
    return *other.value / *first.value - 1.0;
}

report::TextTable comparison_table(const std::vector<StoredResult>& tests) {
    report::TextTable table{"Results", {{"Result", "Unit"}}};
    for (std::size_t k = 0; k < tests.size(); ++k) {
        table.rows.front().push_back(tests[k].name);
        if (k > 0) {
            table.rows.front().push_back("difference");
        }
    }
    for (const auto& name : result_names(tests)) {
        // One unit a row: its numbers can be compared.
        report::Scalar first{name, name, std::nullopt, "", ""};
        std::vector<double> values;
        for (const auto& test : tests) {
            if (const auto* r = find(test, name); r != nullptr && r->value) {
                first = *r;
                values.push_back(*r->value);
            }
        }
        if (values.empty()) {
            continue;
        }
        const report::InUnit shown(first, values);
        std::vector<std::string> row{name, shown.unit};
        const report::Scalar* reference = find(tests.front(), name);
        for (std::size_t k = 0; k < tests.size(); ++k) {
            const auto* r = find(tests[k], name);
            row.push_back(r != nullptr && r->value ? shown.text(*r->value) : "\u2013");
            if (k > 0) {
                const auto off =
                    r != nullptr && reference != nullptr && report::has_ratios(name) ? difference(*reference, *r) : std::nullopt;
                row.push_back(off ? report::relative_change(*off) : "\u2013");
            }
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

report::TextTable comparison_values(const std::vector<StoredResult>& tests) {
    report::TextTable table{"Results in SI units", {{"result", "unit"}}};
    for (const auto& test : tests) {
        table.rows.front().push_back(test.name);
    }
    for (const auto& name : result_names(tests)) {
        std::vector<std::string> row{name, ""};
        for (const auto& test : tests) {
            const auto* r = find(test, name);
            row[1] = r != nullptr && row[1].empty() ? r->unit : row[1];
            row.push_back(r != nullptr && r->value ? fmt::format("{:.17g}", *r->value) : "");
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

report::Plot overlay(const std::vector<StoredResult>& tests, const std::string& x, const std::string& y) {
    report::Plot plot;
    input::Problems problems;
    for (std::size_t k = 0; k < tests.size(); ++k) {
        std::string names[2];
        const report::Table* tables[2] = {table_with(tests[k], x, names[0]), table_with(tests[k], y, names[1])};
        for (int axis = 0; axis < 2; ++axis) {
            if (tables[axis] == nullptr) {
                std::vector<std::string> known;
                for (const report::Table* table : {&tests[k].curve, &tests[k].energy}) {
                    for (const auto& column : table->columns) {
                        known.push_back(column.name);
                    }
                }
                const std::string& wanted = axis == 0 ? x : y;
                const std::string near = input::nearest(wanted, known);
                problems.push_back({tests[k].folder, "", "no column \"" + wanted + "\"", fmt::format("one of {}", fmt::join(known, ", ")),
                                    near.empty() ? "" : "did you mean \"" + near + "\"?"});
            }
        }
        if (tables[0] == nullptr || tables[1] == nullptr) {
            continue;
        }
        report::Curve curve{tests[k].name, tables[0]->values(names[0]), tables[1]->values(names[1])};
        report::tell_apart(curve, k);
        const ShownColumn along = shown_column(names[0]);
        const ShownColumn up = shown_column(names[1]);
        for (auto& value : curve.x) {
            value *= along.factor;
        }
        for (auto& value : curve.y) {
            value *= up.factor;
        }
        plot.x_title = along.title;
        plot.y_title = up.title;
        plot.curves.push_back(std::move(curve));
    }
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
    plot.title =
        fmt::format("{} against {}.", plot.y_title.substr(0, plot.y_title.find(" [")), plot.x_title.substr(0, plot.x_title.find(" [")));
    return plot;
}

report::Record comparison(const std::vector<StoredResult>& tests, const std::string& x, const std::string& y) {
    report::Record record;
    record.title = fmt::format("{} tests compared", tests.size());
    record.subtitle = "differences are from the first: " + tests.front().name;
    record.status = "complete";
    for (const auto& test : tests) {
        if (test.status != "complete") {
            record.warnings.push_back(fmt::format("{} is {}.", test.name, test.status.empty() ? "without a status" : test.status));
        }
        if (test.test != tests.front().test) {
            record.warnings.push_back(
                fmt::format("{} is a {} test, {} a {} test.", test.name, test.test, tests.front().name, tests.front().test));
        }
    }
    std::vector<std::pair<std::string, std::string>> said; // a warning, and who has it
    for (const auto& test : tests) {
        for (const auto& warning : test.warnings) {
            const auto same = std::find_if(said.begin(), said.end(), [&](const auto& other) { return other.first == warning; });
            if (same == said.end()) {
                said.emplace_back(warning, test.name);
            } else {
                same->second += ", " + test.name;
            }
        }
    }
    for (const auto& [warning, names] : said) {
        record.warnings.push_back(names + ": " + warning);
    }
    record.plots.push_back(overlay(tests, x, y));
    record.tables.push_back(comparison_table(tests));
    return record;
}

} // namespace proveta
