#include "specimens/vtk_check.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <stdexcept>

#include "specimens/solid_content.hpp"

namespace proveta::vtk {

namespace {

using solid_files::parse;
using solid_files::shown;
using solid_files::space;
using solid_files::text_of;

// What VTK's reader takes for the beginning of a section.
constexpr std::array<std::string_view, 11> keywords{"POINTS",   "CELLS", "CELL_TYPES", "CELL_DATA",       "POINT_DATA", "FIELD",
                                                    "VERTICES", "LINES", "POLYGONS",   "TRIANGLE_STRIPS", "METADATA"};

// A legacy file.
class LegacyCheck {
  public:
    LegacyCheck(const std::string& file, const std::string& dataset) : file_(file), text_(text_of(file)) {
        std::size_t at = 0;
        for (const std::string_view expected : {"#", "VTK", "DATAFILE", "VERSION"}) {
            if (upper(word(at)) != expected) {
                fail("cannot be read: # vtk DataFile Version is expected in the first line");
            }
        }
        const std::string_view version = word(at);
        if (version.size() != 3 || version[0] < '1' || version[0] > '5' || version[1] != '.') {
            fail(fmt::format("cannot be read: a version from 1.0 to 5.1 is expected and {} was found", shown(version)));
        }
        lists_ = version[0] < '5';
        for (int line = 0; line < 2; ++line) { // the rest of the first and the title
            at = std::min(text_.find('\n', at), text_.size() - 1) + 1;
        }
        body_ = at;
        binary_ = upper(word(at)) == "BINARY";
        for (const std::string_view expected : {std::string_view("DATASET"), std::string_view(dataset)}) {
            const std::string_view found = word(at);
            if (upper(found) != expected) {
                fail(fmt::format("cannot be read: DATASET {} is expected in the fourth line and {} was found", dataset, shown(found)));
            }
        }
        data_ = at;
    }

    // The file with those sections only: VTK's reader ends the program at a field of data that it does not understand, wherever in a line
    // it begins. Data of points and cells come last and may be called like a section.
    [[nodiscard]] std::string text(std::initializer_list<std::string_view> wanted) const {
        std::string out = text_.substr(0, data_) + '\n';
        bool keep = false;
        for (std::size_t at = data_, from = data_; from < text_.size();) {
            const std::string found = upper(word(at));
            const auto begins = [&](std::string_view keyword) { return found.starts_with(keyword); };
            const bool end = found.empty() || begins("POINT_DATA") || begins("CELL_DATA");
            if (end || std::any_of(keywords.begin(), keywords.end(), begins)) {
                const std::size_t here = at - found.size();
                out += keep ? text_.substr(from, here - from) : "";
                from = here;
                keep = std::find(wanted.begin(), wanted.end(), found) != wanted.end();
            }
            if (end) {
                break;
            }
        }
        return out;
    }

    // Lists of cells: of a section of that name, if it is there. Returns how many.
    std::size_t check_cells(const char* section) const {
        std::size_t at = body_;
        if (!find_first(section, at)) {
            return 0;
        }
        const std::size_t cells = count(at);
        const std::size_t size = count(at);
        if (lists_) {
            check_lists(section, cells, integers(at, size, section, 4));
        } else {
            skip_array(at, "OFFSETS", cells);
            skip_array(at, "CONNECTIVITY", size);
        }
        refuse_second(section, at);
        return lists_ || cells == 0 ? cells : cells - 1; // offsets are one more
    }
    void check_types(std::size_t cells, const CheckType& check) const {
        std::size_t at = body_;
        if (!find_first("CELL_TYPES", at)) {
            return;
        }
        const std::size_t n = count(at);
        const auto type = integers(at, n, "CELL_TYPES", 4);
        if (type.size() != cells) {
            fail(fmt::format("{} cells and {} types of cells", cells, type.size()));
        }
        for (std::size_t k = 0; k < type.size(); ++k) {
            check(type[k], k);
        }
        refuse_second("CELL_TYPES", at);
    }
    void check_points() const {
        std::size_t at = body_;
        if (!find_first("POINTS", at)) {
            return;
        }
        const std::size_t values = 3 * count(at);
        const std::string type = upper(word(at));
        if (type != "FLOAT" && type != "DOUBLE") {
            fail(fmt::format("POINTS: float or double is expected and {} was found", shown(type)));
        }
        if (binary_) {
            at = std::min(text_.find('\n', at), text_.size() - 1) + 1;
            const std::size_t bytes = type == "FLOAT" ? 4 : 8;
            if (values > (text_.size() - at) / bytes) {
                fail("the file ends in POINTS");
            }
            at += values * bytes;
        }
        for (std::size_t k = 0; !binary_ && k < values; ++k) {
            double value = 0.0;
            if (const std::string_view found = word(at); !parse(found, value)) {
                fail(fmt::format("POINTS: {} numbers are expected and number {} is {}", values, k + 1,
                                 found.empty() ? "missing: the file ends" : shown(found)));
            }
        }
        refuse_second("POINTS", at);
    }

  private:
    [[noreturn]] void fail(const std::string& what) const { throw std::runtime_error(file_ + ": " + what); }

    static std::string upper(std::string_view text) {
        std::string out(text);
        std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
        return out;
    }
    [[nodiscard]] std::string_view word(std::size_t& at) const {
        at = std::min(text_.find_first_not_of(space, at), text_.size());
        const std::size_t end = std::min(text_.find_first_of(space, at), text_.size());
        const std::string_view out = std::string_view(text_).substr(at, end - at);
        at = end;
        return out;
    }
    // The next word that begins with a keyword, in either case, as VTK finds them; and the place behind it. Empty where there is none.
    [[nodiscard]] std::string_view find(std::string_view keyword, std::size_t& at) const {
        const auto same = [](char a, char b) { return std::toupper(static_cast<unsigned char>(a)) == b; };
        for (auto from = text_.begin() + static_cast<std::ptrdiff_t>(at);;) {
            const auto hit = std::search(from, text_.end(), keyword.begin(), keyword.end(), same);
            if (hit == text_.end()) {
                return {};
            }
            if (hit == text_.begin() || space.find(*(hit - 1)) != std::string_view::npos) {
                at = static_cast<std::size_t>(hit - text_.begin());
                return word(at);
            }
            from = hit + 1;
        }
    }
    [[nodiscard]] bool find_first(std::string_view keyword, std::size_t& at) const {
        const std::string_view found = find(keyword, at);
        if (!found.empty() && found.size() != keyword.size()) {
            fail(fmt::format("{} is expected and {} was found", keyword, shown(found)));
        }
        return !found.empty();
    }
    // VTK's reader would take both. Arrays of data may be called the same: behind their names are a type, or two numbers and a type.
    void refuse_second(std::string_view keyword, std::size_t at) const {
        const auto begins = [](std::string_view text, int (*kind)(int)) {
            return !text.empty() && kind(static_cast<unsigned char>(text[0])) != 0;
        };
        while (!find(keyword, at).empty()) {
            std::size_t behind = at;
            const std::string_view first = word(behind);
            (void)word(behind);
            if (!begins(first, std::isalpha) && !begins(word(behind), std::islower)) {
                fail(fmt::format("a second section {}", keyword));
            }
        }
    }
    [[nodiscard]] std::size_t count(std::size_t& at) const {
        const std::string_view found = word(at);
        long long value = 0;
        if (!parse(found, value)) {
            fail(fmt::format("a number of points, cells or values is expected and {} was found", shown(found)));
        }
        if (value < 0 || static_cast<std::size_t>(value) > text_.size()) {
            fail(fmt::format("{} points, cells or values are announced, which a file of {} bytes cannot hold", value, text_.size()));
        }
        return static_cast<std::size_t>(value);
    }
    // bytes: of each in a binary file.
    [[nodiscard]] std::vector<long long> integers(std::size_t& at, std::size_t n, const char* section, std::size_t bytes) const {
        std::vector<long long> out;
        if (binary_) {
            at = std::min(text_.find('\n', at), text_.size() - 1) + 1;
            if (n > (text_.size() - at) / bytes) {
                fail(fmt::format("the file ends in {}", section));
            }
        }
        for (std::size_t k = 0; k < n; ++k) {
            long long value = 0;
            if (binary_) {
                value = big_endian(at, bytes);
                at += bytes;
            } else if (const std::string_view found = word(at); !parse(found, value)) {
                fail(fmt::format("{}: {} whole numbers are expected and number {} is {}", section, n, k + 1,
                                 found.empty() ? "missing: the file ends" : shown(found)));
            }
            out.push_back(value);
        }
        return out;
    }
    [[nodiscard]] long long big_endian(std::size_t at, std::size_t bytes) const {
        std::uint64_t out = 0;
        for (std::size_t k = 0; k < bytes; ++k) {
            out = out << 8U | static_cast<unsigned char>(text_[at + k]);
        }
        return bytes == 4 ? static_cast<std::int32_t>(out) : static_cast<long long>(out);
    }
    // An array of a section since version 5: its name, its type and its numbers.
    void skip_array(std::size_t& at, const char* name, std::size_t n) const {
        if (const std::string_view found = word(at); upper(found) != name) {
            fail(fmt::format("{} is expected and {} was found", name, found.empty() ? "the end of the file" : shown(found)));
        }
        const std::string_view type = word(at);
        const std::string kind = upper(type);
        const bool wide = kind == "VTKTYPEINT64" || kind == "LONG";
        if (!wide && kind != "VTKTYPEINT32" && kind != "INT" && kind != "VTKIDTYPE") { // the last is written as int
            fail(fmt::format("{}: whole numbers are expected and the type is {}", name, shown(type)));
        }
        (void)integers(at, n, name, wide ? 8 : 4);
    }
    // Cells as lists: a number of points and the points.
    void check_lists(const char* section, std::size_t cells, const std::vector<long long>& value) const {
        std::size_t at = 0;
        for (std::size_t k = 0; k < cells; ++k) {
            const auto left = static_cast<long long>(value.size() - std::min(at + 1, value.size()));
            if (at >= value.size() || value[at] < 0 || value[at] > left) {
                fail(fmt::format("{}: cell {} has more points than the section has numbers", section, k + 1));
            }
            at += 1 + static_cast<std::size_t>(value[at]);
        }
        if (at != value.size()) {
            fail(fmt::format("{}: {} numbers are announced and {} cells hold {}", section, value.size(), cells, at));
        }
    }

    std::string file_;
    std::string text_;
    std::size_t body_ = 0; // where the third line begins
    std::size_t data_ = 0; // behind the fourth
    bool lists_ = false;   // before version 5: cells as lists, without offsets
    bool binary_ = false;
};

} // namespace

std::string checked_grid(const std::string& file, const CheckType& check) {
    const LegacyCheck legacy(file, "UNSTRUCTURED_GRID");
    legacy.check_points();
    legacy.check_types(legacy.check_cells("CELLS"), check);
    return legacy.text({"POINTS", "CELLS", "CELL_TYPES"});
}

std::string checked_polygons(const std::string& file) {
    const LegacyCheck legacy(file, "POLYDATA");
    legacy.check_points();
    for (const char* section : {"VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS"}) {
        legacy.check_cells(section);
    }
    return legacy.text({"POINTS", "VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS"});
}

void check_cells(vtkCellArray& cells, long long points, const std::string& file) {
    vtkDataArray* offsets = cells.GetOffsetsArray();
    vtkDataArray* ids = cells.GetConnectivityArray();
    const auto listed = static_cast<double>(ids->GetNumberOfValues());
    double last = 0.0;
    for (vtkIdType k = 0; k < offsets->GetNumberOfValues(); ++k) {
        const double offset = offsets->GetComponent(k, 0);
        if (!(offset >= last && offset <= listed) || (k == 0 && offset != 0.0)) {
            throw std::runtime_error(fmt::format("{}: offset {} of the cells is {}; {} points are listed", file, k + 1, offset, listed));
        }
        last = offset;
    }
    for (vtkIdType k = 0; k < ids->GetNumberOfValues(); ++k) {
        const double id = ids->GetComponent(k, 0);
        if (!(id >= 0.0 && id < static_cast<double>(points))) {
            throw std::runtime_error(fmt::format("{}: a cell has point {}, and there are {}", file, id, points));
        }
    }
}

} // namespace proveta::vtk
