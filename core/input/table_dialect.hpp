// How a text table is written: what separates its cells, and what its decimals have.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace proveta::input {

enum class Cell { missing, number, text };

/// A way of writing tables.
struct TableDialect {
    char separator = ','; ///< ' ': any run of blanks and tabs
    char decimal = '.';

    /// What a cell is; value: of a number.
    [[nodiscard]] Cell kind(std::string_view cell, double& value) const;
    /// Splits a line into cells, without blanks and quotes around them; they point into it. False: a quotation mark never closes.
    bool split(std::string_view line, std::vector<std::string_view>& cells) const;
    /// Reads a line of text that is nothing but as many numbers as `row` has; at: where it begins, then where the next one does. False: it
    /// is not, or is not plainly written, and `at` stays; split() tells.
    bool read_row(std::string_view text, std::size_t& at, std::vector<double>& row) const;
    /// "semicolons separate, decimals have a comma".
    [[nodiscard]] std::string text() const;
};

/// The dialect in which most of the lines are rows of one number of cells with numbers in them.
TableDialect dialect_of(const std::vector<std::string_view>& lines);

} // namespace proveta::input
