#include "specimens/vtk_legacy.hpp"

#include "specimens/vtk_legacy_text.hpp"

namespace proveta::vtk {

namespace {

using input::shown;

class LegacyReader {
  public:
    LegacyReader(const std::string& file, const std::string& dataset) : file_(file), in_(file) { read_head(dataset); }

    Legacy read() {
        while (true) {
            const std::string_view found = in_.word();
            const std::string section = in_capitals(found);
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
                in_.pass_over_field();
            } else if (section == "METADATA") {
                in_.pass_over_metadata();
            } else {
                in_.fail(fmt::format("a section, such as POINTS or CELLS, is expected and {} was found", shown(found)));
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

    void read_head(const std::string& dataset) {
        for (const std::string_view expected : {"#", "VTK", "DATAFILE", "VERSION"}) {
            if (in_capitals(in_.word()) != expected) {
                in_.fail("cannot be read: # vtk DataFile Version is expected in the first line");
            }
        }
        const std::string_view version = in_.word();
        if (version.size() != 3 || version[0] < '1' || version[0] > '5' || version[1] != '.') {
            in_.fail(fmt::format("cannot be read: a version from 1.0 to 5.1 is expected and {} was found", shown(version)));
        }
        lists_ = version[0] < '5';
        in_.next_line(); // the title
        in_.next_line();
        const std::string_view form = in_.word();
        const bool binary = in_capitals(form) == "BINARY";
        if (!binary && in_capitals(form) != "ASCII") {
            in_.fail(fmt::format("cannot be read: ASCII or BINARY is expected in the third line and {} was found", shown(form)));
        }
        in_.set_binary(binary);
        for (const std::string_view expected : {std::string_view("DATASET"), std::string_view(dataset)}) {
            if (const std::string_view found = in_.word(); in_capitals(found) != expected) {
                in_.fail(fmt::format("cannot be read: DATASET {} is expected in the fourth line and {} was found", dataset, shown(found)));
            }
        }
    }

    void once(const std::string& section) {
        if (std::find(seen_.begin(), seen_.end(), section) != seen_.end()) {
            in_.fail(fmt::format("a second section {}", section));
        }
        seen_.push_back(section);
    }

    void read_points() {
        const std::size_t n = in_.count("POINTS", 3);
        if (n >= solid_files::no_node) {
            in_.fail("too many points");
        }
        std::vector<double> values;
        in_.numbers<double>(3 * n, in_.number_type("POINTS", true), "POINTS", [&](double value) { values.push_back(value); });
        for (std::size_t k = 0; k < n; ++k) {
            out_.point.emplace_back(values[3 * k], values[3 * k + 1], values[3 * k + 2]);
        }
    }
    void read_types() { out_.type = in_.whole_numbers(in_.count("CELL_TYPES"), {4, NumberType::whole}, "CELL_TYPES"); }

    void read_cells(const std::string& section) {
        const std::size_t n = in_.count(section); // since version 5 the number of offsets, one more than cells
        const std::size_t size = in_.count(section);
        Numbers& out = numbers_[section];
        if (n == 0 && size == 0 && !in_.begins_with("OFFSETS")) {
            return;
        }
        if (lists_) {
            split_lists(section, n, in_.whole_numbers(size, {4, NumberType::whole}, section), out);
            return;
        }
        out.offset = read_array("OFFSETS", n);
        out.listed = read_array("CONNECTIVITY", size);
        if (n > 0 && out.offset.back() != static_cast<long long>(size)) {
            in_.fail(fmt::format("{}: the last offset is {}, and {} points are listed", section, out.offset.back(), size));
        }
    }
    // An array of a section since version 5: its name, its type and its numbers.
    std::vector<long long> read_array(const char* name, std::size_t n) {
        if (const std::string_view found = in_.word(); in_capitals(found) != name) {
            in_.fail(fmt::format("{} is expected and {} was found", name, found.empty() ? "the end of the file" : shown(found)));
        }
        return in_.whole_numbers(n, in_.number_type(name, false), name);
    }
    // Before: a number of points and the points, cell by cell.
    void split_lists(const std::string& section, std::size_t cells, const std::vector<long long>& value, Numbers& out) const {
        out.offset = {0};
        std::size_t at = 0;
        for (std::size_t k = 0; k < cells; ++k) {
            if (at >= value.size() || value[at] < 0 || static_cast<std::size_t>(value[at]) > value.size() - at - 1) {
                in_.fail(fmt::format("{}: cell {} has more points than the section has numbers", section, k + 1));
            }
            const std::size_t end = at + 1 + static_cast<std::size_t>(value[at]);
            out.listed.insert(out.listed.end(), value.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                              value.begin() + static_cast<std::ptrdiff_t>(end));
            out.offset.push_back(static_cast<long long>(out.listed.size()));
            at = end;
        }
        if (at != value.size()) {
            in_.fail(fmt::format("{}: {} numbers are announced and {} cells hold {}", section, value.size(), cells, at));
        }
    }

    std::string file_;
    LegacyText in_;
    bool lists_ = false; // before version 5: cells as lists, without offsets
    std::vector<std::string> seen_;
    std::map<std::string, Numbers> numbers_;
    Legacy out_;
};

} // namespace

Legacy read_legacy(const std::string& file, const std::string& dataset) { return LegacyReader(file, dataset).read(); }

} // namespace proveta::vtk