#include "lab/trials/csv.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "core/input/text_file.hpp"

namespace proveta {

namespace {

std::vector<std::string> cells_of(const std::string& line) {
    // Where commas or semicolons or tabs separate, cells may be empty; spaces separate only where nothing else does.
    const char separator = line.find(';') != std::string::npos    ? ';'
                           : line.find(',') != std::string::npos  ? ','
                           : line.find('\t') != std::string::npos ? '\t'
                                                                  : ' ';
    std::vector<std::string> out(1);
    for (const char c : line) {
        if (c != separator) {
            out.back() += c;
        } else if (separator != ' ' || !out.back().empty()) {
            out.emplace_back();
        }
    }
    for (auto& cell : out) {
        const auto first = cell.find_first_not_of(" \t\"");
        const auto last = cell.find_last_not_of(" \t\"");
        cell = first == std::string::npos ? "" : cell.substr(first, last - first + 1);
    }
    if (separator == ' ' && out.back().empty()) {
        out.pop_back();
    }
    return out;
}

bool to_number(const std::string& cell, double& value) {
    if (cell == "nan") {
        value = std::nan("");
        return true;
    }
    const char* begin = cell.data() + (cell.starts_with('+') ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, cell.data() + cell.size(), value);
    return error == std::errc() && end == cell.data() + cell.size();
}

} // namespace

report::Table read_csv(const std::string& file) {
    std::istringstream in(input::read_text(file, 64 << 20));
    report::Table table;
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
        if (!line.empty() && line.back() == '\r') {
            line.pop_back();
        }
        if (line.find_first_not_of(" \t") == std::string::npos || line.front() == '#') {
            continue;
        }
        const auto cells = cells_of(line);
        std::vector<double> row(cells.size());
        std::size_t bad = cells.size();
        for (std::size_t k = 0; k < cells.size() && bad == cells.size(); ++k) {
            bad = to_number(cells[k], row[k]) ? bad : k;
        }
        if (table.columns.empty()) {
            for (std::size_t k = 0; k < cells.size(); ++k) {
                table.columns.push_back({bad < cells.size() ? cells[k] : std::to_string(k + 1), "", ""});
            }
            if (bad < cells.size()) {
                continue;
            }
        }
        if (bad < cells.size()) {
            throw std::runtime_error(fmt::format("{}: line {}: \"{}\" is no number", file, number, cells[bad]));
        }
        if (cells.size() != table.columns.size()) {
            throw std::runtime_error(fmt::format("{}: line {}: {} values, expected {}", file, number, cells.size(), table.columns.size()));
        }
        table.rows.push_back(std::move(row));
    }
    if (table.rows.empty()) {
        throw std::runtime_error(file + ": no rows of numbers");
    }
    return table;
}

} // namespace proveta
