// Records of Gmsh's files: lines of numbers, or the same numbers as bytes.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/input/words.hpp"
#include "specimens/solid_content.hpp"

namespace proveta::solid_files {

/// A file of Gmsh's taken record by record, and each of them number by number, which knows where it is: in which line, or at which byte.
/// Lines without text are passed over. What is not as expected is an std::runtime_error with the file, the place, what is expected and
/// what was found.
class GmshRecords {
  public:
    GmshRecords(std::string file, std::string text) : file_(std::move(file)), text_(std::move(text)) {
        const std::size_t end = std::min(text_.find_first_of("\r\n"), text_.size());
        line_end_ = text_.compare(end, 1, "\r") == 0 && text_.compare(end, 2, "\r\n") != 0 ? '\r' : '\n';
    }

    /// Numbers between begin_bytes() and end_bytes() are bytes from now on. size: bytes of a number of things. turned: the highest byte
    /// comes first.
    void set_binary(std::size_t size, bool turned) {
        binary_ = true;
        size_ = size;
        turned_ = turned;
    }
    void begin_bytes() { bytes_ = binary_; }
    void end_bytes() { bytes_ = false; }
    [[nodiscard]] bool are_bytes() const { return bytes_; }

    /// Takes the next line; false at the end of the file.
    bool next() {
        field_ = 0;
        fields_.clear();
        while (fields_.empty() && at_ < text_.size()) {
            const std::size_t end = std::min(text_.find(line_end_, at_), text_.size());
            line_ = std::string_view(text_).substr(at_, end - at_);
            start_ = at_;
            at_ = std::min(end + 1, text_.size());
            ++number_;
            fields_ = input::words_of(line_);
        }
        return !fields_.empty();
    }
    /// Begins the next record, which is of `what`, and of so many numbers where they are given.
    void need(std::string_view what, std::size_t numbers = 0) {
        if (bytes_) {
            return;
        }
        if (!next()) {
            fail(fmt::format("the file ends where {} is expected", what));
        }
        if (numbers > 0 && fields_.size() != numbers) {
            fail(fmt::format("{} is expected, of {} numbers, and {} was found", what, numbers, input::shown(line_)));
        }
    }
    void need_word(const std::string& word) {
        need(word);
        if (fields_[0] != word) {
            fail(fmt::format("{} is expected and {} was found", word, input::shown(line_)));
        }
    }
    /// Passes over all up to the line that ends a section.
    void pass_over(const std::string& end) {
        const std::size_t found = text_.find(line_end_ + end, at_ - 1);
        if (found == std::string::npos) {
            number_ += static_cast<std::size_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_ - 1), text_.end(), line_end_));
            fail(fmt::format("the file ends where {} is expected", end));
        }
        number_ += static_cast<std::size_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                                       text_.begin() + static_cast<std::ptrdiff_t>(std::max(found + 1, at_)), line_end_));
        at_ = found + 1;
        need_word(end);
    }

    [[nodiscard]] std::string_view word(std::size_t k = 0) const { return fields_[k]; }
    [[nodiscard]] std::string_view line() const { return line_; }
    /// How many numbers of the record's line are still to be taken.
    [[nodiscard]] std::size_t left_in_line() const { return fields_.size() - field_; }
    /// Where the record begins, as fail_at() and text_of() take it: its line or, in a binary file, its byte.
    [[nodiscard]] std::size_t place() const { return bytes_ ? at_ : binary_ ? start_ : number_; }
    [[nodiscard]] std::string text_of(std::size_t place) const { return fmt::format("{} {}", binary_ ? "byte" : "line", place); }

    /// What is wrong with the record's last number.
    [[noreturn]] void fail(const std::string& what) const { fail_at(binary_ ? start_ : number_, what); }
    [[noreturn]] void fail_at(std::size_t place, const std::string& what) const {
        throw std::runtime_error(fmt::format("{}:{}{}: {}", file_, binary_ ? " byte " : "", place, what));
    }

    /// The record's next number: whole, of four bytes.
    long long integer(std::string_view what) { return bytes_ ? whole_of_bytes(4, what) : whole_of_text(what); }
    /// One that counts or names things, of as many bytes as the file says.
    long long size(std::string_view what) { return bytes_ ? whole_of_bytes(size_, what) : whole_of_text(what); }
    double real(std::string_view what) {
        double value = 0.0;
        if (bytes_) {
            std::memcpy(&value, take(8, what).data(), 8);
            if (!std::isfinite(value)) {
                fail(fmt::format("{} is expected and {} was found", what, value));
            }
        } else if (field_ >= fields_.size() || !parse(fields_[field_], value) || !std::isfinite(value)) {
            unexpected(what);
        } else {
            ++field_;
        }
        return value;
    }
    /// A number of records or numbers still to come, each of which takes two bytes or more.
    std::size_t count(std::string_view what) { return checked(size(what), what); }
    /// The same of four bytes.
    std::size_t count_of_integers(std::string_view what) { return checked(integer(what), what); }

  private:
    std::size_t checked(long long value, std::string_view what) const {
        const std::size_t left = text_.size() - at_ + (bytes_ ? 0 : line_.size());
        if (value < 0 || static_cast<std::size_t>(value) > left / 2) {
            fail(fmt::format("{} is {}, which the rest of the file, {} bytes, cannot hold", what, value, left));
        }
        return static_cast<std::size_t>(value);
    }
    // Bytes of a number, in this machine's order.
    std::string take(std::size_t bytes, std::string_view what) {
        if (bytes > text_.size() - at_) {
            start_ = at_;
            fail(fmt::format("the file ends where {} is expected", what));
        }
        std::string out = text_.substr(at_, bytes);
        start_ = at_;
        at_ += bytes;
        if (turned_) {
            std::reverse(out.begin(), out.end());
        }
        return out;
    }
    long long whole_of_bytes(std::size_t bytes, std::string_view what) {
        if (bytes == 8) {
            std::uint64_t value = 0;
            std::memcpy(&value, take(8, what).data(), 8);
            if (value > largest) {
                fail(fmt::format("{} is {}, which there cannot be", what, value));
            }
            return static_cast<long long>(value);
        }
        std::int32_t value = 0;
        std::memcpy(&value, take(4, what).data(), 4);
        return value;
    }
    long long whole_of_text(std::string_view what) {
        long long value = 0;
        if (field_ >= fields_.size() || !parse(fields_[field_], value) || std::max(value, -(value + 1)) > static_cast<long long>(largest)) {
            unexpected(what);
        }
        ++field_;
        return value;
    }
    [[noreturn]] void unexpected(std::string_view what) const {
        fail(fmt::format("{} is expected and {} was found", what,
                         field_ < fields_.size() ? input::shown(fields_[field_]) : std::string("the end of the line")));
    }

    static constexpr std::uint64_t largest = std::uint64_t{1} << 60U; // which leaves room for signs and sums

    std::string file_;
    std::string text_;
    char line_end_ = '\n';
    bool binary_ = false;
    bool bytes_ = false;
    bool turned_ = false;
    std::size_t size_ = 8;
    std::string_view line_;
    std::vector<std::string_view> fields_;
    std::size_t field_ = 0; // the next one
    std::size_t at_ = 0;
    std::size_t start_ = 0;  // of the line or of the last number as bytes
    std::size_t number_ = 0; // of the line
};

} // namespace proveta::solid_files
