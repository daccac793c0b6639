// proveta compare, proveta plot
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "lab/cli/commands.hpp"
#include "lab/compare.hpp"
#include "lab/output_folder.hpp"
#include "lab/provenance.hpp"
#include "reports/files.hpp"
#include "reports/html.hpp"
#include "reports/svg.hpp"

namespace proveta {

namespace {

struct PlotArguments {
    std::vector<std::string> folders;
    std::string x = "axial_strain";
    std::string y = "axial_stress";
    std::string out;
};

void add_columns(CLI::App& command, PlotArguments& a) {
    command.add_option("folders", a.folders, "result folders of tests; a series stands for its members")->required();
    command.add_option("--x", a.x, "column of curve.csv or energy.csv, with or without its unit")->capture_default_str();
    command.add_option("--y", a.y, "the same, up the page")->capture_default_str();
}

// A table with its columns side by side.
std::string aligned(const report::TextTable& table) {
    std::vector<std::size_t> width;
    for (const auto& row : table.rows) {
        width.resize(std::max(width.size(), row.size()), 0);
        for (std::size_t c = 0; c < row.size(); ++c) {
            width[c] = std::max(width[c], row[c].size());
        }
    }
    std::string out;
    for (const auto& row : table.rows) {
        for (std::size_t c = 0; c < row.size(); ++c) {
            out += c < 2 ? fmt::format("{:<{}}  ", row[c], width[c]) : fmt::format("{:>{}}  ", row[c], width[c]);
        }
        out.resize(out.find_last_not_of(' ') + 1);
        out += '\n';
    }
    return out;
}

// A result that is compared, or a series that holds it, is no earlier comparison to be replaced.
void refuse_to_replace(const PlotArguments& a, const std::vector<StoredResult>& tests) {
    namespace fs = std::filesystem;
    const fs::path out = fs::weakly_canonical(a.out);
    std::vector<input::Problem> problems;
    std::set<std::string> folders(a.folders.begin(), a.folders.end());
    for (const auto& test : tests) {
        folders.insert(test.folder);
    }
    for (const auto& folder : folders) {
        const fs::path within = fs::weakly_canonical(folder).lexically_relative(out);
        if (!within.empty() && *within.begin() != "..") {
            problems.push_back({"--out", "", fmt::format("\"{}\", which {} \"{}\"", a.out, within == "." ? "is" : "holds", folder),
                                "a folder that the comparison may replace", ""});
        }
    }
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
}

int compare(const PlotArguments& a, const std::string& typed) {
    const auto tests = read_results(a.folders);
    const report::Record record = comparison(tests, a.x, a.y);
    refuse_to_replace(a, tests);
    OutputFolder out(a.out);
    out.begin();
    report::write_file(out.file("comparison.csv"), report::to_csv(comparison_values(tests)));
    report::write_file(out.file("report.html"), report::to_html(record));
    input::Json sheet{{"proveta_comparison_manifest", 1}, {"status", "complete"}};
    sheet.update(program_facts());
    sheet.update({{"command", typed}, {"written", now_utc()}, {"folders", a.folders}});
    out.write_manifest(sheet);
    fmt::print("{}", aligned(record.tables.front()));
    for (const auto& warning : record.warnings) {
        fmt::print("warning: {}\n", warning);
    }
    fmt::print("results in {}\n", out.path().string());
    return 0;
}

int plot(const PlotArguments& a) {
    report::Plot drawn = overlay(read_results(a.folders), a.x, a.y);
    if (std::filesystem::path(a.out).extension() != ".svg") {
        throw input::InputError(
            {{"--out", "", "\"" + a.out + "\"", "the name of an .svg file", "browsers, Inkscape and word processors open it"}});
    }
    report::write_file(a.out, report::to_svg(drawn));
    fmt::print("{} curves in {}\n", drawn.curves.size(), a.out);
    return 0;
}

} // namespace

void add_compare(CLI::App& app, const std::string& typed, Command& chosen) {
    auto a = std::make_shared<PlotArguments>();
    a->out = "results/comparison";
    auto* command = app.add_subcommand("compare", "curves of tests in one plot, and their results with the differences from the first");
    add_columns(*command, *a);
    command->add_option("--out", a->out, "folder of the page and the table")->capture_default_str();
    command->callback([a, typed, &chosen] { chosen = [a, typed] { return compare(*a, typed); }; });
}

void add_plot(CLI::App& app, Command& chosen) {
    auto a = std::make_shared<PlotArguments>();
    a->out = "plot.svg";
    auto* command = app.add_subcommand("plot", "any two columns of tests against each other, as SVG");
    add_columns(*command, *a);
    command->add_option("--out", a->out, "file")->capture_default_str();
    command->callback([a, &chosen] { chosen = [a] { return plot(*a); }; });
}

} // namespace proveta
