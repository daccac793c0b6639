#include "lab/verification/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "reports/files.hpp"
#include "reports/svg.hpp"

namespace proveta::verification {

bool Finished::holds() const {
    return failure.empty() && std::all_of(outcome.checks.begin(), outcome.checks.end(), [](const Check& c) { return c.holds(); });
}

Finished run(const Case& which) {
    Finished out;
    out.which = &which;
    const auto start = std::chrono::steady_clock::now();
    try {
        out.outcome = which.run();
        if (out.outcome.checks.empty()) {
            out.failure = "the case checked nothing";
        }
    } catch (const std::exception& e) {
        out.failure = e.what();
    }
    out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return out;
}

namespace {

const std::vector<std::string> heading{"case", "quantity", "expected", "found", "error", "allowed", "thesis", "verdict"};

std::string with_unit(double value, const std::string& unit) { return fmt::format("{:.6g}{}{}", value, unit.empty() ? "" : " ", unit); }

std::string share(double value) { return std::fabs(value) < 1e-3 ? fmt::format("{:.1e}", value) : fmt::format("{:.2f} %", 100.0 * value); }

std::string expected(const Check& c) {
    switch (c.how) {
    case Compare::at_most: return "<= " + with_unit(c.expected, c.unit);
    case Compare::at_least: return ">= " + with_unit(c.expected, c.unit);
    case Compare::reported: return "-";
    default: return with_unit(c.expected, c.unit);
    }
}

std::string error(const Check& c) {
    if (c.how == Compare::relative) {
        return share(c.error());
    }
    return c.how == Compare::absolute ? fmt::format("{:.2g}", c.error()) : "-";
}

std::string allowed(const Check& c) {
    if (c.how == Compare::relative) {
        return share(c.tolerance);
    }
    return c.how == Compare::absolute ? fmt::format("{:.2g}", c.tolerance) : "-";
}

// "exact" prints better than an error of 1e-17.
std::string trimmed(const std::string& text) { return text == "0.0e+00" ? "0" : text; }

} // namespace

std::vector<std::vector<std::string>> rows(const Finished& f) {
    std::vector<std::vector<std::string>> out;
    for (const auto& c : f.outcome.checks) {
        out.push_back({f.which->name, c.quantity, expected(c), with_unit(c.found, c.unit), trimmed(error(c)), trimmed(allowed(c)),
                       c.thesis.empty() ? "-" : c.thesis, c.how == Compare::reported ? "shown" : (c.holds() ? "holds" : "FAILS")});
    }
    if (!f.failure.empty()) {
        out.push_back({f.which->name, f.failure, "-", "-", "-", "-", "-", "FAILS"});
    }
    return out;
}

std::string as_text(const std::vector<Finished>& finished) {
    std::vector<std::vector<std::string>> lines{heading};
    for (const auto& f : finished) {
        for (const auto& row : rows(f)) {
            lines.push_back(row);
        }
    }
    std::vector<std::size_t> width(heading.size(), 0);
    for (const auto& line : lines) {
        for (std::size_t k = 0; k < line.size(); ++k) {
            width[k] = std::max(width[k], line[k].size());
        }
    }
    std::string out;
    for (const auto& line : lines) {
        for (std::size_t k = 0; k < line.size(); ++k) {
            out += k + 1 < line.size() ? fmt::format("{:<{}}  ", line[k], width[k]) : line[k];
        }
        out += "\n";
    }
    return out;
}

std::string plot_file(const Case& which, std::size_t k) { return k == 0 ? which.name : fmt::format("{}-{}", which.name, k + 1); }

std::string as_markdown(const std::vector<Finished>& finished, const std::string& folder) {
    std::string out;
    for (const auto& f : finished) {
        out += fmt::format("\n## {}\n\n{}{} `proveta verify {}`\n\n", f.which->name, f.which->about,
                           f.which->section.empty() ? "" : " Thesis " + f.which->section + ".", f.which->name);
        out += "| quantity | expected | found | error | allowed | thesis | verdict |\n|---|---|---|---|---|---|---|\n";
        for (const auto& row : rows(f)) {
            out += fmt::format("| {} |\n", fmt::join(row.begin() + 1, row.end(), " | "));
        }
        for (const auto& note : f.outcome.notes) {
            out += "\n" + note + "\n";
        }
        for (std::size_t k = 0; k < f.outcome.plots.size(); ++k) {
            out += fmt::format("\n![{}]({}/{}.svg)\n", f.outcome.plots[k].title, folder, plot_file(*f.which, k));
        }
    }
    return out;
}

void write_plots(const Finished& f, const std::string& folder) {
    const auto file = [&](const std::string& name) { return (std::filesystem::path(folder) / name).string(); };
    for (std::size_t k = 0; k < f.outcome.plots.size(); ++k) {
        const report::Plot& plot = f.outcome.plots[k];
        const std::string name = plot_file(*f.which, k);
        report::write_file(file(name + ".svg"), report::to_svg(plot));
        std::string csv = fmt::format("# {}\n# x: {}; y: {}\ncurve,x,y\n", plot.title, plot.x_title, plot.y_title);
        for (const auto& curve : plot.curves) {
            for (std::size_t p = 0; p < curve.x.size(); ++p) {
                csv += fmt::format("\"{}\",{:.9g},{:.9g}\n", curve.name, curve.x[p], curve.y[p]);
            }
        }
        report::write_file(file(name + ".csv"), csv);
    }
}

} // namespace proveta::verification
