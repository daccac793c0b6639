// The text of VTK's legacy files: words, numbers and what is passed over.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/input/words.hpp"
#include "specimens/solid_content.hpp"

namespace proveta::vtk {

// How a number stands in a binary file.
struct NumberType {
    std::size_t bytes;
    enum { whole, positive, real } kind;
};
inline const std::map<std::string, NumberType> number_types{{"FLOAT", {4, NumberType::real}},
                                                            {"DOUBLE", {8, NumberType::real}},
                                                            {"CHAR", {1, NumberType::whole}},
                                                            {"SIGNED_CHAR", {1, NumberType::whole}},
                                                            {"SHORT", {2, NumberType::whole}},
                                                            {"INT", {4, NumberType::whole}},
                                                            {"LONG", {8, NumberType::whole}},
                                                            {"VTKTYPEINT32", {4, NumberType::whole}},
                                                            {"VTKTYPEINT64", {8, NumberType::whole}},
                                                            {"VTKIDTYPE", {4, NumberType::whole}}, // which is written as int
                                                            {"UNSIGNED_CHAR", {1, NumberType::positive}},
                                                            {"UNSIGNED_SHORT", {2, NumberType::positive}},
                                                            {"UNSIGNED_INT", {4, NumberType::positive}},
                                                            {"UNSIGNED_LONG", {8, NumberType::positive}},
                                                            {"VTKTYPEUINT64", {8, NumberType::positive}}};

inline std::string in_capitals(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return out;
}

/// A legacy file that is read from its beginning on. All functions throw std::runtime_error, naming the file and what is wrong with it.
class LegacyText {
  public:
    explicit LegacyText(const std::string& file) : file_(file), text_(solid_files::text_of(file)) {}

    [[noreturn]] void fail(const std::string& what) const { throw std::runtime_error(file_ + ": " + what); }
    /// Whether numbers stand as bytes.
    void set_binary(bool binary) { binary_ = binary; }

    /// The next word; empty at the end of the file.
    std::string_view word() {
        const std::size_t from = std::min(text_.find_first_not_of(input::blanks, at_), text_.size());
        at_ = std::min(text_.find_first_of(input::blanks, from), text_.size());
        return std::string_view(text_).substr(from, at_ - from);
    }
    /// Whether the next word is this one, in either case.
    [[nodiscard]] bool begins_with(const char* expected) {
        const std::size_t here = at_;
        const std::string found = in_capitals(word());
        at_ = here;
        return found == expected;
    }
    /// Goes behind the end of the line.
    void next_line() { at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1; }

    /// Passes over what is told about an array, up to a line without text.
    void pass_over_metadata() {
        for (next_line(); at_ < text_.size() && text_.find_first_not_of(" \t\r", at_) != text_.find('\n', at_); next_line()) {
        }
    }
    /// Passes over arrays that belong to the whole: no part of a mesh, whatever they are called.
    void pass_over_field() {
        (void)word();
        for (std::size_t left = count("FIELD"); left > 0;) {
            const std::string name(word());
            if (name == "METADATA") {
                pass_over_metadata();
                continue;
            }
            const std::size_t components = count(name);
            const std::size_t tuples = count(name);
            if (components > 0 && tuples > text_.size() / components) {
                fail(fmt::format("{}: more values than the file can hold", input::shown(name)));
            }
            const std::size_t values = components * tuples;
            if (begins_with("STRING")) {
                pass_over_texts(values);
            } else if (begins_with("BIT") && binary_) {
                next_line();
                pass_over_bytes((values + 7) / 8);
            } else if (begins_with("BIT")) {
                (void)word();
                numbers<double>(values, {1, NumberType::whole}, name, [](double) {});
            } else {
                numbers<double>(values, number_type(name, true), name, [](double) {});
            }
            --left;
        }
    }

    /// How many of something follow, `values` numbers of each; no more than the file has room for.
    std::size_t count(const std::string& section, std::size_t values = 1) {
        const std::string_view found = word();
        if (found.empty() || found.find_first_not_of("0123456789") != std::string_view::npos) {
            fail(fmt::format("{}: a number of points, cells or values is expected and {} was found", section, input::shown(found)));
        }
        std::size_t n = 0;
        const std::size_t left = text_.size() - at_;
        if (!solid_files::parse(found, n) || n > left / values) {
            fail(
                fmt::format("{}: {} are announced, which the rest of the file, {} bytes, cannot hold", section, input::shown(found), left));
        }
        return n;
    }
    NumberType number_type(const std::string& what, bool may_be_real) {
        const std::string_view name = word();
        const auto found = number_types.find(in_capitals(name));
        if (found == number_types.end() || (found->second.kind == NumberType::real && !may_be_real)) {
            fail(
                fmt::format("{}: {} are expected and the type is {}", what, may_be_real ? "numbers" : "whole numbers", input::shown(name)));
        }
        return found->second;
    }

    /// Calls use(value) for n numbers, which begin behind the line in a binary file.
    template <class Number, class Use> void numbers(std::size_t n, NumberType type, const std::string& section, const Use& use) {
        if (binary_) {
            next_line();
            if (n > (text_.size() - at_) / type.bytes) {
                fail(fmt::format("the file ends in {}", section));
            }
        }
        for (std::size_t k = 0; k < n; ++k) {
            Number value = 0;
            if (binary_) {
                value = big_endian<Number>(type);
            } else if (const std::string_view found = word(); !solid_files::parse(found, value)) {
                fail(fmt::format("{}: {} numbers are expected and number {} is {}", section, n, k + 1,
                                 found.empty() ? "missing: the file ends" : input::shown(found)));
            }
            use(value);
        }
    }
    std::vector<long long> whole_numbers(std::size_t n, NumberType type, const std::string& section) {
        std::vector<long long> out;
        numbers<long long>(n, type, section, [&](long long value) { out.push_back(value); });
        return out;
    }

  private:
    void pass_over_bytes(std::size_t bytes) {
        if (bytes > text_.size() - at_) {
            fail("the file ends in FIELD");
        }
        at_ += bytes;
    }
    // Texts: a line each; in a binary file behind their lengths, whose own length is told by two bits.
    void pass_over_texts(std::size_t n) {
        next_line();
        for (std::size_t k = 0; k < n; ++k) {
            if (!binary_) {
                next_line();
                continue;
            }
            pass_over_bytes(1);
            const auto first = static_cast<unsigned char>(text_[--at_]);
            const std::size_t bytes = std::size_t{8} >> (first >> 6U);
            pass_over_bytes(bytes);
            std::uint64_t length = first & 63U;
            for (std::size_t b = at_ - bytes + 1; b < at_; ++b) {
                length = length << 8U | static_cast<unsigned char>(text_[b]);
            }
            pass_over_bytes(length);
        }
    }
    template <class Number> Number big_endian(NumberType type) {
        std::uint64_t bits = 0;
        for (std::size_t k = 0; k < type.bytes; ++k) {
            bits = bits << 8U | static_cast<unsigned char>(text_[at_++]);
        }
        if (type.kind == NumberType::positive) {
            return static_cast<Number>(bits);
        }
        if (type.kind == NumberType::whole) {
            const std::size_t above = 64 - 8 * type.bytes;
            return static_cast<Number>(static_cast<std::int64_t>(bits << above) >> above); // with its sign
        }
        if (type.bytes == 4) {
            return static_cast<Number>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
        }
        return static_cast<Number>(std::bit_cast<double>(bits));
    }

    std::string file_;
    std::string text_;
    std::size_t at_ = 0;
    bool binary_ = false;
};

} // namespace proveta::vtk
