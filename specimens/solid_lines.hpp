// Text files of meshes, line by line.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "specimens/solid_content.hpp"

namespace proveta::solid_files {

/// A text file taken line by line and split at white space, which knows where it is. Lines without text are passed over. What is not
/// as expected is an std::runtime_error with the file, the line, what is expected and what was found.
class Lines {
  public:
    Lines(std::string file, std::string text) : file_(std::move(file)), text_(std::move(text)) {}

    bool next() {
        field_.clear();
        while (field_.empty() && at_ < text_.size()) {
            const std::size_t end = std::min(text_.find('\n', at_), text_.size());
            line_ = std::string_view(text_).substr(at_, end - at_);
            at_ = end + 1;
            ++number_;
            split();
        }
        return !field_.empty();
    }
    // The next line, where `what` is expected.
    void need(std::string_view what) {
        if (!next()) {
            throw std::runtime_error(fmt::format("{}:{}: the file ends where {} is expected", file_, number_, what));
        }
    }
    void need(std::string_view what, std::size_t fields) {
        need(what);
        if (size() != fields) {
            fail(fmt::format("{} is expected, of {} numbers, and {} was found", what, fields, shown(line_)));
        }
    }
    void need_word(const std::string& word) {
        need(word);
        if (field_[0] != word) {
            fail(fmt::format("{} is expected and {} was found", word, shown(line_)));
        }
    }

    [[nodiscard]] std::size_t size() const { return field_.size(); }
    [[nodiscard]] std::string_view operator[](std::size_t k) const { return field_[k]; }
    [[nodiscard]] std::string_view line() const { return line_; }
    [[nodiscard]] std::size_t number() const { return number_; }

    [[noreturn]] void fail(const std::string& what) const { fail_at(number_, what); }
    [[noreturn]] void fail_at(std::size_t line, const std::string& what) const {
        throw std::runtime_error(fmt::format("{}:{}: {}", file_, line, what));
    }

    [[nodiscard]] long long integer(std::size_t k, std::string_view what) const {
        long long value = 0;
        // The bound leaves room for signs and sums.
        if (k >= size() || !parse(field_[k], value) || std::max(value, -(value + 1)) > (1LL << 60)) {
            wrong(k, what);
        }
        return value;
    }
    [[nodiscard]] double real(std::size_t k, std::string_view what) const {
        double value = 0.0;
        if (k >= size() || !parse(field_[k], value) || !std::isfinite(value)) {
            wrong(k, what);
        }
        return value;
    }
    // A number of lines or fields still to come, each of which takes a character and a space or more.
    [[nodiscard]] std::size_t count(std::size_t k, std::string_view what) const {
        const long long value = integer(k, what);
        const std::size_t left = text_.size() - std::min(at_, text_.size()) + line_.size();
        if (value < 0 || static_cast<std::size_t>(value) > left / 2) {
            fail(fmt::format("{} is {}, which the rest of the file, {} bytes, cannot hold", what, value, left));
        }
        return static_cast<std::size_t>(value);
    }

  private:
    void split() {
        for (std::size_t at = line_.find_first_not_of(space); at < line_.size();) {
            const std::size_t end = std::min(line_.find_first_of(space, at), line_.size());
            field_.push_back(line_.substr(at, end - at));
            at = line_.find_first_not_of(space, end);
        }
    }
    [[noreturn]] void wrong(std::size_t k, std::string_view what) const {
        fail(fmt::format("{} is expected and {} was found", what, k < size() ? shown(field_[k]) : "the end of the line"));
    }

    std::string file_;
    std::string text_;
    std::string_view line_;
    std::vector<std::string_view> field_;
    std::size_t at_ = 0;
    std::size_t number_ = 0;
};

} // namespace proveta::solid_files
