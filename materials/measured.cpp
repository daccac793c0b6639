#include "materials/measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "core/input/text_file.hpp"
#include "core/input/text_table.hpp"

namespace proveta {

namespace {

constexpr const char* heading = "confinement_MPa,axial_strain,lateral_strain,axial_stress_MPa,kind";

// Lines that are no comments, without blanks and quotes, at most two: the headings and whether anything follows.
std::vector<std::string> first_lines(const std::string& file) {
    std::istringstream in(input::as_utf8(input::read_text(file, input::longest_table), file));
    std::vector<std::string> out;
    for (std::string line; out.size() < 2 && std::getline(in, line);) {
        std::erase_if(line, [](unsigned char c) { return std::isspace(c) != 0 || c == '"'; });
        if (!line.empty() && line.front() != '#') {
            out.push_back(line);
        }
    }
    return out;
}

bool is_heading(std::string line) {
    std::replace(line.begin(), line.end(), ';', ',');
    return line == heading;
}

} // namespace

bool is_measured_curve(const std::string& file) {
    const auto lines = first_lines(file);
    return !lines.empty() && is_heading(lines.front());
}

MeasuredCurve load_measured_curve(const std::string& file) {
    const auto lines = first_lines(file);
    if (lines.empty() || !is_heading(lines.front())) {
        throw std::runtime_error(fmt::format("{}: the heading should be {}", file, heading));
    }
    MeasuredCurve curve;
    if (lines.size() < 2) {
        return curve;
    }
    const input::TextTable table(file);
    const auto column = [&](const char* name) { return table.numbers(table.find(name)); };
    const auto confinement = column("confinement_MPa");
    curve.axial_strain = column("axial_strain");
    curve.lateral_strain = column("lateral_strain");
    curve.axial_stress = column("axial_stress_MPa");
    const std::size_t kind = table.find("kind");
    for (std::size_t k = 0; k < table.rows(); ++k) {
        const auto fail = [&](const std::string& what) {
            throw std::runtime_error(fmt::format("{}: line {}: {}", file, table.line(k), what));
        };
        const auto word = table.cell(k, kind);
        if (word != "total" && word != "deviatoric") {
            fail(fmt::format("kind \"{}\" is neither total nor deviatoric", word));
        }
        if (!std::isfinite(confinement[k] + curve.axial_strain[k] + curve.axial_stress[k])) {
            fail("a value is missing");
        }
        if (k > 0 && (1e6 * confinement[k] != curve.confinement || (word == "total") != curve.total)) {
            fail("another confinement or kind than in the rows before; a file holds one curve");
        }
        curve.confinement = 1e6 * confinement[k];
        curve.total = word == "total";
        curve.axial_stress[k] *= 1e6;
    }
    return curve;
}

} // namespace proveta
