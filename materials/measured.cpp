#include "materials/measured.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "core/input/text_file.hpp"

namespace proveta {

namespace {

constexpr std::uintmax_t longest = 64 << 20; // bytes, some million rows
constexpr const char* heading = "confinement_MPa,axial_strain,lateral_strain,axial_stress_MPa,kind";

// The next line that is no comment, without spaces.
bool next_line(std::istream& in, std::string& line, int& number) {
    while (std::getline(in, line)) {
        ++number;
        std::erase_if(line, [](unsigned char c) { return std::isspace(c) != 0; });
        if (!line.empty() && line.front() != '#') {
            return true;
        }
    }
    return false;
}

} // namespace

bool is_measured_curve(const std::string& file) {
    std::istringstream in(input::read_text(file, longest));
    std::string line;
    int number = 0;
    return next_line(in, line, number) && line == heading;
}

MeasuredCurve load_measured_curve(const std::string& file) {
    std::istringstream in(input::read_text(file, longest));
    std::string line;
    int number = 0;
    const auto fail = [&](const std::string& what) { throw std::runtime_error(fmt::format("{}: line {}: {}", file, number, what)); };
    if (!next_line(in, line, number) || line != heading) {
        fail(std::string("the heading should be ") + heading);
    }
    MeasuredCurve curve;
    while (next_line(in, line, number)) {
        std::vector<std::string> cells(1);
        for (const char c : line) {
            c == ',' ? cells.emplace_back() : cells.back() += c;
        }
        if (cells.size() != 5) {
            fail(fmt::format("{} cells, expected 5", cells.size()));
        }
        const auto number_in = [&](std::size_t k) {
            double value = 0.0;
            const auto [end, error] = std::from_chars(cells[k].data(), cells[k].data() + cells[k].size(), value);
            if (error != std::errc() || end != cells[k].data() + cells[k].size()) {
                fail("\"" + cells[k] + "\" is no number");
            }
            return value;
        };
        if (cells[4] != "total" && cells[4] != "deviatoric") {
            fail("kind \"" + cells[4] + "\" is neither total nor deviatoric");
        }
        const double confinement = 1e6 * number_in(0);
        const bool total = cells[4] == "total";
        if (!curve.empty() && (confinement != curve.confinement || total != curve.total)) {
            fail("another confinement or kind than in the rows before; a file holds one curve");
        }
        curve.confinement = confinement;
        curve.total = total;
        curve.axial_strain.push_back(number_in(1));
        curve.lateral_strain.push_back(cells[2].empty() ? std::nan("") : number_in(2));
        curve.axial_stress.push_back(1e6 * number_in(3));
    }
    return curve;
}

} // namespace proveta
