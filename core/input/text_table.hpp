// Tables of numbers in text files, as measuring programs, spreadsheets and people write them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/input/table_dialect.hpp"
#include "core/input/text_file.hpp"

namespace proveta::input {

/// A column as the file names it.
struct TextColumn {
    std::string heading; ///< as written, without quotes; empty where the file has no headings
    std::string name;    ///< the heading without its unit
    std::string unit;    ///< as written, in the heading or in a row of units; empty: none is said
};

/// A text file of rows and columns. What it finds out by itself: whether commas, semicolons, tabs or blanks separate; whether decimals have
/// a point or a comma; a byte-order mark, UTF-16; quotes; lines of comments (#) and of other matter before the headings; headings and a row
/// of units under them; which columns are numbers. Empty cells and NaN, NA, N/A, #N/A, null, - are missing.
class TextTable {
  public:
    /// Reads a file. Throws std::runtime_error naming file, line and what is wrong: no rows, a row with other columns than the rest, quotes
    /// that never close, a decimal comma where commas separate too. most: bytes, more are refused.
    explicit TextTable(std::string file, std::uintmax_t most = longest_table);

    [[nodiscard]] const std::string& file() const { return file_; }
    [[nodiscard]] const std::vector<TextColumn>& columns() const { return columns_; }
    [[nodiscard]] std::size_t rows() const { return line_.size(); }
    [[nodiscard]] bool has_headings() const { return headings_; }
    /// Why what stands above the rows does not name the columns; empty: nothing does, or it names them.
    [[nodiscard]] const std::string& passed_over() const { return passed_over_; }
    /// Line of the file, from 1, in which a row stands.
    [[nodiscard]] std::size_t line(std::size_t row) const { return line_[row]; }
    /// What is written in a cell; its line is looked at again.
    [[nodiscard]] std::string_view cell(std::size_t row, std::size_t column) const;
    /// Whether a cell is neither a number nor missing.
    [[nodiscard]] bool is_text(std::size_t row, std::size_t column) const;
    /// Whether most of a column's cells are numbers.
    [[nodiscard]] bool is_number(std::size_t column) const { return numeric_[column]; }

    /// A column's numbers; missing cells are NaN. Throws std::runtime_error naming the line of a cell that is neither.
    [[nodiscard]] const std::vector<double>& numbers(std::size_t column) const;
    /// The same; cells that are neither are NaN, too.
    [[nodiscard]] const std::vector<double>& values(std::size_t column) const { return values_[column]; }

    /// Index of a column by its heading, its name without unit, or its number from 1. Throws std::runtime_error when there is none, naming
    /// those that there are, or when two have that heading.
    [[nodiscard]] std::size_t find(const std::string& wanted) const;

    /// "2 columns (strain, stress) and 30 rows; semicolons separate, decimals have a comma".
    [[nodiscard]] std::string description() const;

  private:
    [[noreturn]] void fail(std::size_t line, const std::string& what) const;
    void split(std::string_view text, std::size_t line, std::vector<std::string_view>& cells) const;
    void name_columns(const std::vector<std::vector<std::string_view>>& above);
    void take_rows(std::size_t at, std::size_t number);
    void take_row(const std::vector<std::string_view>& cells);

    std::string file_;
    std::string text_;
    TableDialect dialect_;
    bool headings_ = false;
    std::string passed_over_;
    std::vector<TextColumn> columns_;
    std::vector<bool> numeric_;
    std::vector<std::vector<double>> values_;     // of each column; NaN where a cell is missing or text
    std::vector<std::vector<std::size_t>> texts_; // of each column, the rows with text there, as many as an error would name
    std::vector<std::size_t> line_;               // of each row, the number of its line
    std::vector<std::size_t> at_;                 // of each row, where its line begins in text_
};

} // namespace proveta::input
