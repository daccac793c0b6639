#include "specimens/vtk_legacy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <stdexcept>

#include "specimens/solid_content.hpp"

namespace proveta::vtk {

namespace {

using solid_files::parse;
using solid_files::shown;
using solid_files::space;
using solid_files::text_of;

// How a number stands in a binary file.
struct NumberType {
    std::size_t bytes;
    enum { whole, positive, real } kind;
};
const std::map<std::string, NumberType> number_types{{"FLOAT", {4, NumberType::real}},
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

std::string in_capitals(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return out;
}

class LegacyReader {
  public:
    LegacyReader(const std::string& file, const std::string& dataset) : file_(file), text_(text_of(file)) { read_head(dataset); }

    Legacy read() {
        while (true) {
            const std::size_t before = at_;
            const std::string section = in_capitals(word());
            if (section.empty() || section == "POINT_DATA" || section == "CELL_DATA") { // which come last
                break;
            }
            if (section == "POINTS") {
                once(section);
                read_points();
            } else if (section == "CELL_TYPES") {
                once(section);
                read_types();
            } else if (section == "CELLS" || section == "VERTICES" || section == "LINES" || section == "POLYGONS" ||
                       section == "TRIANGLE_STRIPS") {
                once(section);
                read_cells(section);
            } else if (section == "FIELD") {
                pass_over_field();
            } else if (section == "METADATA") {
                pass_over_metadata();
            } else {
                at_ = before;
                fail(fmt::format("a section, such as POINTS or CELLS, is expected and {} was found", shown(word())));
            }
        }
        for (const auto& [section, numbers] : numbers_) {
            out_.cells[section] = cell_lists(numbers.offset, numbers.listed, out_.point.size(), file_);
        }
        return std::move(out_);
    }

  private:
    struct Numbers {
        std::vector<long long> offset;
        std::vector<long long> listed;
    };

    [[noreturn]] void fail(const std::string& what) const { throw std::runtime_error(file_ + ": " + what); }

    void read_head(const std::string& dataset) {
        for (const std::string_view expected : {"#", "VTK", "DATAFILE", "VERSION"}) {
            if (in_capitals(word()) != expected) {
                fail("cannot be read: # vtk DataFile Version is expected in the first line");
            }
        }
        const std::string_view version = word();
        if (version.size() != 3 || version[0] < '1' || version[0] > '5' || version[1] != '.') {
            fail(fmt::format("cannot be read: a version from 1.0 to 5.1 is expected and {} was found", shown(version)));
        }
        lists_ = version[0] < '5';
        next_line(); // the title
        next_line();
        const std::string_view form = word();
        binary_ = in_capitals(form) == "BINARY";
        if (!binary_ && in_capitals(form) != "ASCII") {
            fail(fmt::format("cannot be read: ASCII or BINARY is expected in the third line and {} was found", shown(form)));
        }
        for (const std::string_view expected : {std::string_view("DATASET"), std::string_view(dataset)}) {
            if (const std::string_view found = word(); in_capitals(found) != expected) {
                fail(fmt::format("cannot be read: DATASET {} is expected in the fourth line and {} was found", dataset, shown(found)));
            }
        }
    }

    // The next word; empty at the end of the file.
    std::string_view word() {
        const std::size_t from = std::min(text_.find_first_not_of(space, at_), text_.size());
        at_ = std::min(text_.find_first_of(space, from), text_.size());
        return std::string_view(text_).substr(from, at_ - from);
    }
    [[nodiscard]] bool begins_with(const char* expected) {
        const std::size_t here = at_;
        const std::string found = in_capitals(word());
        at_ = here;
        return found == expected;
    }
    void next_line() { at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1; }

    void once(const std::string& section) {
        if (std::find(seen_.begin(), seen_.end(), section) != seen_.end()) {
            fail(fmt::format("a second section {}", section));
        }
        seen_.push_back(section);
    }
    // What is told about an array, up to a line without text.
    void pass_over_metadata() {
        for (next_line(); at_ < text_.size() && text_.find_first_not_of(" \t\r", at_) != text_.find('\n', at_); next_line()) {
        }
    }
    // Arrays that belong to the whole: no part of a mesh, whatever they are called.
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
                fail(fmt::format("{}: more values than the file can hold", shown(name)));
            }
            const std::size_t values = components * tuples;
            const std::string_view type = word();
            if (in_capitals(type) == "STRING") {
                pass_over_texts(values);
            } else if (in_capitals(type) == "BIT" && binary_) {
                next_line();
                pass_over_bytes((values + 7) / 8);
            } else if (in_capitals(type) == "BIT") {
                numbers<double>(values, {1, NumberType::whole}, name, [](double) {});
            } else if (const auto found = number_types.find(in_capitals(type)); found != number_types.end()) {
                numbers<double>(values, found->second, name, [](double) {});
            } else {
                fail(fmt::format("{}: an array of type {}, which is not known", shown(name), shown(type)));
            }
            --left;
        }
    }
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

    // How many of something follow, `values` numbers of each; no more than the file has room for.
    std::size_t count(const std::string& section, std::size_t values = 1) {
        const std::string_view found = word();
        if (found.empty() || found.find_first_not_of("0123456789") != std::string_view::npos) {
            fail(fmt::format("{}: a number of points, cells or values is expected and {} was found", section, shown(found)));
        }
        std::size_t n = 0;
        const std::size_t left = text_.size() - at_;
        if (!parse(found, n) || n > left / values) {
            fail(fmt::format("{}: {} are announced, which the rest of the file, {} bytes, cannot hold", section, shown(found), left));
        }
        return n;
    }
    NumberType number_type(const std::string& what, bool may_be_real) {
        const std::string_view name = word();
        const auto found = number_types.find(in_capitals(name));
        if (found == number_types.end() || (found->second.kind == NumberType::real && !may_be_real)) {
            fail(fmt::format("{}: {} are expected and the type is {}", what, may_be_real ? "numbers" : "whole numbers", shown(name)));
        }
        return found->second;
    }

    // Calls use(value) for n numbers, which begin behind the line in a binary file.
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
            } else if (const std::string_view found = word(); !parse(found, value)) {
                fail(fmt::format("{}: {} numbers are expected and number {} is {}", section, n, k + 1,
                                 found.empty() ? "missing: the file ends" : shown(found)));
            }
            use(value);
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
    std::vector<long long> whole_numbers(std::size_t n, NumberType type, const std::string& section) {
        std::vector<long long> out;
        numbers<long long>(n, type, section, [&](long long value) { out.push_back(value); });
        return out;
    }

    void read_points() {
        const std::size_t n = count("POINTS", 3);
        if (n >= solid_files::no_node) {
            fail("too many points");
        }
        std::vector<double> values;
        numbers<double>(3 * n, number_type("POINTS", true), "POINTS", [&](double value) { values.push_back(value); });
        for (std::size_t k = 0; k < n; ++k) {
            out_.point.emplace_back(values[3 * k], values[3 * k + 1], values[3 * k + 2]);
        }
    }
    void read_types() { out_.type = whole_numbers(count("CELL_TYPES"), {4, NumberType::whole}, "CELL_TYPES"); }

    void read_cells(const std::string& section) {
        const std::size_t n = count(section); // since version 5 the number of offsets, one more than cells
        const std::size_t size = count(section);
        Numbers& out = numbers_[section];
        if (n == 0 && size == 0 && !begins_with("OFFSETS")) {
            return;
        }
        if (lists_) {
            split_lists(section, n, whole_numbers(size, {4, NumberType::whole}, section), out);
            return;
        }
        out.offset = read_array("OFFSETS", n);
        out.listed = read_array("CONNECTIVITY", size);
        if (n > 0 && out.offset.back() != static_cast<long long>(size)) {
            fail(fmt::format("{}: the last offset is {}, and {} points are listed", section, out.offset.back(), size));
        }
    }
    // An array of a section since version 5: its name, its type and its numbers.
    std::vector<long long> read_array(const char* name, std::size_t n) {
        if (const std::string_view found = word(); in_capitals(found) != name) {
            fail(fmt::format("{} is expected and {} was found", name, found.empty() ? "the end of the file" : shown(found)));
        }
        return whole_numbers(n, number_type(name, false), name);
    }
    // Before: a number of points and the points, cell by cell.
    void split_lists(const std::string& section, std::size_t cells, const std::vector<long long>& value, Numbers& out) const {
        out.offset = {0};
        std::size_t at = 0;
        for (std::size_t k = 0; k < cells; ++k) {
            if (at >= value.size() || value[at] < 0 || static_cast<std::size_t>(value[at]) > value.size() - at - 1) {
                fail(fmt::format("{}: cell {} has more points than the section has numbers", section, k + 1));
            }
            const std::size_t end = at + 1 + static_cast<std::size_t>(value[at]);
            out.listed.insert(out.listed.end(), value.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                              value.begin() + static_cast<std::ptrdiff_t>(end));
            out.offset.push_back(static_cast<long long>(out.listed.size()));
            at = end;
        }
        if (at != value.size()) {
            fail(fmt::format("{}: {} numbers are announced and {} cells hold {}", section, value.size(), cells, at));
        }
    }

    std::string file_;
    std::string text_;
    std::size_t at_ = 0;
    bool lists_ = false; // before version 5: cells as lists, without offsets
    bool binary_ = false;
    std::vector<std::string> seen_;
    std::map<std::string, Numbers> numbers_;
    Legacy out_;
};

} // namespace

Legacy read_legacy(const std::string& file, const std::string& dataset) { return LegacyReader(file, dataset).read(); }

} // namespace proveta::vtk
