#include "core/input/text_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "core/input/column_heading.hpp"
#include "core/input/large_pages.hpp"
#include "core/input/suggest.hpp"
#include "core/input/table_lines.hpp"
#include "core/input/words.hpp"

namespace proveta::input {

namespace {

constexpr std::size_t looked_at = 400; // lines from which dialect and columns are made out
constexpr std::size_t most_named = 8;  // lines with the same fault
constexpr const char* only_points = "; if decimals have a comma here, separate cells by semicolons or tabs";

// A comment, or nothing at all; "#N/A" is a missing cell.
bool is_comment(std::string_view line) {
    const auto s = trimmed(line);
    return s.empty() || (s.front() == '#' && !s.starts_with("#N/A") && !s.starts_with("#NA")) || s.starts_with("//");
}

} // namespace

void TextTable::fail(std::size_t line, const std::string& what) const {
    throw std::runtime_error(fmt::format("{}: line {}: {}", file_, line, what));
}

void TextTable::split(std::string_view text, std::size_t line, std::vector<std::string_view>& cells) const {
    if (!dialect_.split(text, cells)) {
        fail(line, "a quotation mark that never closes");
    }
}

TextTable::TextTable(std::string file, std::uintmax_t most) : file_(std::move(file)), text_(read_text(file_, most)) {
    text_ = utf8_of_latin1(as_utf8(std::move(text_), file_));
    std::vector<std::string_view> sample;
    std::vector<std::size_t> first; // their numbers, from 1
    std::string_view comment;       // the last before the first of them
    std::size_t number = 0;
    for (std::size_t at = 0; at < text_.size() && sample.size() < looked_at;) {
        const auto line = take_line(text_, at);
        ++number;
        if (!is_comment(line)) {
            sample.push_back(line);
            first.push_back(number);
        } else if (sample.empty() && line.find('#') != line.npos) {
            comment = line.substr(line.find('#') + 1);
        }
    }
    dialect_ = dialect_of(sample);

    std::vector<std::vector<std::string_view>> rows(first.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
        split(sample[k], first[k], rows[k]);
    }
    const std::size_t width = width_of(rows, dialect_);
    if (width == 0) {
        throw std::runtime_error(file_ + ": no rows of numbers" + first_words(rows, first, dialect_));
    }
    numeric_ = columns_of_numbers(rows, width, dialect_);

    // Rows of numbers begin where a line has them in all columns that should; what stands above names the columns.
    const auto is_row = [&](const std::vector<std::string_view>& cells) {
        bool any = false;
        double value = 0.0;
        for (std::size_t c = 0; c < width && cells.size() == width; ++c) {
            const Cell found = dialect_.kind(cells[c], value);
            if (numeric_[c] && found == Cell::text) {
                return false;
            }
            any = any || (numeric_[c] && found == Cell::number);
        }
        return any;
    };
    std::size_t begin = 0;
    while (begin < rows.size() && !is_row(rows[begin])) {
        ++begin;
    }
    if (dialect_.separator == ' ') {
        for (std::size_t k = 0; k < begin; ++k) {
            rejoin(rows[k], width);
        }
    }
    // A line without any number names; one with a number in it, under such a line, is a row that is wrong.
    const auto is_heading = [&](const std::vector<std::string_view>& cells) {
        return cells.size() == width && !has_number(cells, dialect_);
    };
    std::size_t names_end = begin;
    while (names_end > 0 && !is_heading(rows[names_end - 1])) {
        --names_end;
    }
    std::vector<std::vector<std::string_view>> above;
    for (std::size_t k = names_end; k > 0 && is_heading(rows[k - 1]) && above.size() < 2; --k) {
        above.insert(above.begin(), rows[k - 1]);
    }
    if (above.empty() && begin == 0 && width > 1 && !comment.empty()) { // headings as NumPy writes them
        std::vector<std::string_view> named;
        if (dialect_.split(comment, named) && is_heading(named)) {
            above.push_back(named);
        }
    }
    columns_.resize(width);
    name_columns(above);
    if (above.empty() && begin > 0) {
        const bool commas = dialect_.separator == ',' && rows[begin - 1].size() < width;
        passed_over_ = fmt::format("line {} was not taken for headings: it has {} cells where the rows have {}{}", first[begin - 1],
                                   rows[begin - 1].size(), width, commas ? only_points : "");
    }
    const std::size_t start = names_end > 0 ? names_end : begin;
    if (start >= first.size()) {
        throw std::runtime_error(file_ + ": no rows of numbers" + first_words(rows, first, dialect_));
    }

    take_rows(static_cast<std::size_t>(sample[start].data() - text_.data()), first[start]);
}

// From a place in the text, and the number of the line there.
void TextTable::take_rows(std::size_t at, std::size_t number) {
    const std::size_t width = columns_.size();
    const auto lines = static_cast<std::size_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at), text_.end(), '\n')) + 1;
    values_.resize(width);
    for (auto& column : values_) {
        column.reserve(lines);
        wish_large_pages(column);
    }
    texts_.resize(width);
    for (auto* of_rows : {&line_, &at_}) {
        of_rows->reserve(lines);
        wish_large_pages(*of_rows);
    }
    std::vector<double> row(width);
    std::vector<std::string_view> cells;
    std::vector<std::pair<std::size_t, std::string>> wrong; // lines, and what is wrong
    for (; at < text_.size(); ++number) {
        const std::size_t begin = at;
        if (dialect_.read_row(text_, at, row)) {
            for (std::size_t c = 0; c < width; ++c) {
                values_[c].push_back(row[c]);
            }
        } else {
            const auto line = take_line(text_, at);
            if (is_comment(line)) {
                continue;
            }
            split(line, number, cells);
            if (cells.size() == width + 1 && cells.back().empty() && dialect_.separator != ' ') {
                cells.pop_back(); // a separator at the end of the line
            }
            if (cells.size() != width) {
                const bool commas = dialect_.separator == ',' && cells.size() > width;
                wrong.emplace_back(number, fmt::format("{} cells where the other rows have {}{}", cells.size(), width,
                                                       commas && wrong.empty() ? only_points : ""));
                if (wrong.size() == most_named) {
                    break;
                }
                continue;
            }
            take_row(cells);
        }
        line_.push_back(number);
        at_.push_back(begin);
    }
    if (!wrong.empty()) {
        std::string others;
        for (std::size_t k = 1; k < wrong.size(); ++k) {
            others += fmt::format("; line {}: {}", wrong[k].first, wrong[k].second);
        }
        fail(wrong.front().first, wrong.front().second + others + (wrong.size() == most_named ? "; ..." : ""));
    }
}

void TextTable::take_row(const std::vector<std::string_view>& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c) {
        double value = 0.0;
        const Cell is = dialect_.kind(cells[c], value);
        values_[c].push_back(is == Cell::number ? value : std::numeric_limits<double>::quiet_NaN());
        if (is == Cell::text && texts_[c].size() < most_named) {
            texts_[c].push_back(line_.size());
        }
    }
}

std::string_view TextTable::cell(std::size_t row, std::size_t column) const {
    std::size_t at = at_[row];
    std::vector<std::string_view> cells;
    split(take_line(text_, at), line_[row], cells);
    return cells[column];
}

bool TextTable::is_text(std::size_t row, std::size_t column) const {
    double value = 0.0;
    return dialect_.kind(cell(row, column), value) == Cell::text;
}

void TextTable::name_columns(const std::vector<std::vector<std::string_view>>& above) {
    headings_ = !above.empty();
    if (!headings_) {
        return;
    }
    const bool units = above.size() == 2 && is_row_of_units(above.back());
    const auto& headings = units ? above.front() : above.back();
    for (std::size_t c = 0; c < columns_.size(); ++c) {
        columns_[c] = column_of_heading(std::string(headings[c]));
        if (units && columns_[c].unit.empty()) {
            columns_[c].unit = unit_in_brackets(std::string(above.back()[c]));
        }
    }
}

const std::vector<double>& TextTable::numbers(std::size_t column) const {
    if (const auto& rows = texts_[column]; !rows.empty()) {
        const auto& heading = columns_[column].heading;
        std::string others;
        for (std::size_t k = 1; k < rows.size(); ++k) {
            others += fmt::format("; line {}: \"{}\"", line_[rows[k]], cell(rows[k], column).substr(0, 40));
        }
        fail(line_[rows.front()],
             fmt::format("\"{}\" is no number{}{}{}", cell(rows.front(), column).substr(0, 40),
                         heading.empty() ? "" : ", in column \"" + heading + "\"", others, rows.size() == most_named ? "; ..." : ""));
    }
    return values_[column];
}

std::size_t TextTable::find(const std::string& wanted) const {
    std::vector<std::size_t> found;
    for (const auto member : {&TextColumn::heading, &TextColumn::name}) {
        for (std::size_t c = 0; c < columns_.size() && headings_; ++c) {
            if (columns_[c].*member == wanted) {
                found.push_back(c);
            }
        }
        if (!found.empty()) {
            break;
        }
    }
    if (found.empty()) {
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            if (wanted == std::to_string(c + 1)) {
                found.push_back(c);
            }
        }
    }
    if (found.size() > 1) {
        throw std::runtime_error(fmt::format("{}: \"{}\" is the heading of columns {} and {}; ask for one of them by its number", file_,
                                             wanted, found[0] + 1, found[1] + 1));
    }
    if (found.empty()) {
        std::vector<std::string> names;
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            names.push_back(headings_ ? "\"" + columns_[c].heading + "\"" : std::to_string(c + 1));
        }
        const std::string near = nearest(wanted, names);
        throw std::runtime_error(fmt::format("{}: no column \"{}\"; there are {}{}{}", file_, wanted, fmt::join(names, ", "),
                                             near.empty() ? "" : "; did you mean " + near + "?",
                                             passed_over_.empty() ? "" : "; " + passed_over_));
    }
    return found.front();
}

std::string TextTable::description() const {
    std::vector<std::string> names;
    for (const auto& c : columns_) {
        names.push_back(c.heading);
    }
    return fmt::format("{} columns{} and {} rows; {}", columns_.size(), headings_ ? fmt::format(" ({})", fmt::join(names, ", ")) : "",
                       rows(), dialect_.text());
}

} // namespace proveta::input
