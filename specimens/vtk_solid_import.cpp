// Unstructured grids of VTK.
#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellTypes.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <new>
#include <numeric>
#include <stdexcept>

#include "specimens/solid_content.hpp"

namespace proveta::solid_files {

namespace {

// Keeps what VTK's readers complain about, instead of the screen. They do so through their own events, through those of their parts and
// through none at all; all of it ends up here.
class Complaints : public vtkOutputWindow {
  public:
    static Complaints* New() { VTK_STANDARD_NEW_BODY(Complaints); }
    Complaints(const Complaints&) = delete;
    Complaints& operator=(const Complaints&) = delete;

    void DisplayText(const char*) override {}
    void DisplayErrorText(const char* text) override { keep(text); }
    void DisplayGenericWarningText(const char* text) override { keep(text); }
    void DisplayWarningText(const char*) override {}
    void DisplayDebugText(const char*) override {}

    [[nodiscard]] bool any() const { return !first_.empty(); }
    // VTK's own words come as "ERROR: In file, line n\nclass (address): what".
    [[nodiscard]] std::string what() const {
        std::string out = first_.substr(0, first_.find_last_not_of(space) + 1);
        const auto line = out.find('\n');
        out = line == std::string::npos ? out : out.substr(line + 1);
        const auto object = out.find("): ");
        out = object == std::string::npos ? out : out.substr(object + 3);
        std::replace(out.begin(), out.end(), '\n', ' ');
        return out;
    }

  protected:
    Complaints() = default;

  private:
    void keep(const char* text) {
        if (first_.empty() && text != nullptr) {
            first_ = text;
        }
    }
    std::string first_;
};

// Puts VTK's output window in another's place, its log off and its words on, which other parts of the program turn off for all; and all of
// it back when it goes.
class WindowKept {
  public:
    explicit WindowKept(vtkOutputWindow* other)
        : old_(vtkOutputWindow::GetInstance()), display_(vtkObject::GetGlobalWarningDisplay()),
          verbosity_(vtkLogger::GetCurrentVerbosityCutoff()) {
        vtkOutputWindow::SetInstance(other);
        vtkObject::GlobalWarningDisplayOn();
        vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    }
    ~WindowKept() {
        vtkLogger::SetStderrVerbosity(verbosity_);
        vtkObject::SetGlobalWarningDisplay(display_);
        vtkOutputWindow::SetInstance(old_);
    }
    WindowKept(const WindowKept&) = delete;
    WindowKept& operator=(const WindowKept&) = delete;

  private:
    vtkSmartPointer<vtkOutputWindow> old_;
    vtkTypeBool display_;
    vtkLogger::Verbosity verbosity_;
};

// Point and cell data are not wanted; the legacy reader knows no way around them.
void leave_data_out(vtkUnstructuredGridReader&) {}
void leave_data_out(vtkXMLUnstructuredGridReader& reader) {
    reader.UpdateInformation();
    reader.GetPointDataArraySelection()->DisableAllArrays();
    reader.GetCellDataArraySelection()->DisableAllArrays();
}

template <class Reader> vtkSmartPointer<vtkUnstructuredGrid> read_with(const std::string& file) {
    const vtkNew<Complaints> complaints;
    const WindowKept kept(complaints);
    vtkSmartPointer<vtkUnstructuredGrid> grid;
    try {
        const vtkNew<Reader> reader;
        reader->SetFileName(file.c_str());
        leave_data_out(*reader);
        reader->Update();
        grid = reader->GetOutput();
    } catch (const std::bad_alloc&) {
        throw std::runtime_error(file + ": announces more than there is memory for");
    } catch (const std::length_error&) {
        throw std::runtime_error(file + ": announces more than there is memory for");
    }
    if (complaints->any() || grid == nullptr) {
        throw std::runtime_error(file + ": cannot be read (" + complaints->what() + ")");
    }
    return grid;
}

Kind vtk_kind_of(long long type, std::size_t cell, const std::string& file) {
    switch (type) {
    case VTK_VERTEX:
    case VTK_POLY_VERTEX: return Kind::point;
    case VTK_LINE:
    case VTK_POLY_LINE: return Kind::line;
    case VTK_TRIANGLE: return Kind::triangle;
    case VTK_QUAD: return Kind::quadrilateral;
    case VTK_TETRA: return Kind::tetrahedron;
    case VTK_HEXAHEDRON: return Kind::hexahedron;
    default: break;
    }
    const char* name =
        type >= 0 && type < VTK_NUMBER_OF_CELL_TYPES ? vtkCellTypes::GetClassNameFromTypeId(static_cast<int>(type)) : nullptr;
    throw std::runtime_error(fmt::format("{}: cell {} is of type {} ({}); bodies are made of linear tetrahedra and hexahedra, membranes of "
                                         "linear triangles and quadrilaterals",
                                         file, cell + 1, type, name == nullptr ? "unknown" : name));
}

// A look at a legacy file before VTK's reader, which trusts the counts and lists in it: it would reach beyond its memory otherwise.
class LegacyCheck {
  public:
    explicit LegacyCheck(const std::string& file) : file_(file), text_(text_of(file)) {
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
        for (const std::string_view expected : {"DATASET", "UNSTRUCTURED_GRID"}) {
            const std::string_view found = word(at);
            if (upper(found) != expected) {
                fail(
                    fmt::format("cannot be read: DATASET UNSTRUCTURED_GRID is expected in the fourth line and {} was found", shown(found)));
            }
        }
    }

    void run() const {
        std::size_t at = body_;
        if (find_first("POINTS", at)) {
            (void)count(at);
        }
        std::size_t cells = 0;
        if (at = body_; find_first("CELLS", at)) {
            cells = count(at);
            const std::size_t size = count(at);
            if (lists_) {
                check_lists(cells, integers(at, size, "CELLS"));
            }
            refuse_second("CELLS", at);
        }
        if (at = body_; find_first("CELL_TYPES", at)) {
            check_types(cells, integers(at, count(at), "CELL_TYPES"));
            refuse_second("CELL_TYPES", at);
        }
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
    [[nodiscard]] std::vector<long long> integers(std::size_t at, std::size_t n, const char* section) const {
        std::vector<long long> out;
        if (binary_) {
            at = std::min(text_.find('\n', at), text_.size() - 1) + 1;
            if (n > (text_.size() - at) / 4) {
                fail(fmt::format("the file ends in {}", section));
            }
        }
        for (std::size_t k = 0; k < n; ++k) {
            long long value = 0;
            if (binary_) {
                value = big_endian(at + 4 * k);
            } else if (const std::string_view found = word(at); !parse(found, value)) {
                fail(fmt::format("{}: {} whole numbers are expected and number {} is {}", section, n, k + 1,
                                 found.empty() ? "missing: the file ends" : shown(found)));
            }
            out.push_back(value);
        }
        return out;
    }
    [[nodiscard]] std::int32_t big_endian(std::size_t at) const {
        std::uint32_t out = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            out = out << 8U | static_cast<unsigned char>(text_[at + k]);
        }
        return static_cast<std::int32_t>(out);
    }
    // Cells as lists: a number of points and the points.
    void check_lists(std::size_t cells, const std::vector<long long>& value) const {
        std::size_t at = 0;
        for (std::size_t k = 0; k < cells; ++k) {
            const auto left = static_cast<long long>(value.size() - std::min(at + 1, value.size()));
            if (at >= value.size() || value[at] < 0 || value[at] > left) {
                fail(fmt::format("CELLS: cell {} has more points than the section has numbers", k + 1));
            }
            at += 1 + static_cast<std::size_t>(value[at]);
        }
        if (at != value.size()) {
            fail(fmt::format("CELLS: {} numbers are announced and {} cells hold {}", value.size(), cells, at));
        }
    }
    void check_types(std::size_t cells, const std::vector<long long>& type) const {
        cells = lists_ || cells == 0 ? cells : cells - 1; // offsets are one more
        if (type.size() != cells) {
            fail(fmt::format("{} cells and {} types of cells", cells, type.size()));
        }
        for (std::size_t k = 0; k < type.size(); ++k) {
            (void)vtk_kind_of(type[k], k, file_);
        }
    }

    std::string file_;
    std::string text_;
    std::size_t body_ = 0; // where the third line begins
    bool lists_ = false;   // before version 5: cells as lists, without offsets
    bool binary_ = false;
};

// Counts that are none, or that no file of this size could hold, even compressed: VTK's reader trusts them.
void check_counts(const std::string& file) {
    const std::string text = text_of(file);
    for (const std::string_view name : {"NumberOfPoints", "NumberOfCells", "NumberOfComponents", "NumberOfTuples"}) {
        for (auto at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
            const auto open = std::min(text.find_first_not_of("= \t\r\n", at + name.size()), text.size() - 1);
            const auto close = text.find(text[open], open + 1);
            if ((text[open] != '"' && text[open] != '\'') || close == std::string::npos) {
                continue; // no attribute
            }
            const std::string_view found = std::string_view(text).substr(open + 1, close - open - 1);
            long long value = 0;
            if (!parse(found, value) || value < 0 || static_cast<std::size_t>(value) / 1000 > text.size()) {
                throw std::runtime_error(
                    fmt::format("{}: {} is {}, which a file of {} bytes cannot hold", file, name, shown(found), text.size()));
            }
        }
    }
}

// Where each cell's points begin among all; one more than there are cells.
std::vector<std::size_t> offsets_of(vtkCellArray& cells, const std::string& file) {
    vtkDataArray* offsets = cells.GetOffsetsArray();
    const auto points = static_cast<double>(cells.GetConnectivityArray()->GetNumberOfValues());
    std::vector<std::size_t> out;
    double last = 0.0;
    for (vtkIdType k = 0; k < offsets->GetNumberOfValues(); ++k) {
        const double offset = offsets->GetComponent(k, 0);
        if (offset < last || offset > points || (k == 0 && offset != 0.0)) {
            throw std::runtime_error(fmt::format("{}: offset {} of the cells is {}; {} points are listed", file, k + 1, offset, points));
        }
        last = offset;
        out.push_back(static_cast<std::size_t>(offset));
    }
    return out;
}

void add_points(vtkUnstructuredGrid& grid, Content& out) {
    const vtkIdType n = grid.GetPoints() == nullptr ? 0 : grid.GetNumberOfPoints();
    for (vtkIdType k = 0; k < n; ++k) {
        double x[3];
        grid.GetPoint(k, x);
        out.node.emplace_back(x[0], x[1], x[2]);
    }
}

void add_cells(vtkUnstructuredGrid& grid, const std::string& file, Content& out) {
    vtkCellArray* cells = grid.GetCells();
    vtkUnsignedCharArray* types = grid.GetCellTypesArray();
    if (cells == nullptr || types == nullptr) {
        return;
    }
    const auto first = offsets_of(*cells, file);
    const std::size_t n = first.empty() ? 0 : first.size() - 1;
    if (types->GetNumberOfValues() != static_cast<vtkIdType>(n)) {
        throw std::runtime_error(fmt::format("{}: {} cells and {} types of cells", file, n, types->GetNumberOfValues()));
    }
    vtkDataArray* point = cells->GetConnectivityArray();
    for (std::size_t k = 0; k < n; ++k) {
        Element element;
        element.kind = vtk_kind_of(types->GetValue(static_cast<vtkIdType>(k)), k, file);
        element.node.fill(no_node);
        if (dimension_of(element.kind) < 2) { // of any number of points, and of no use
            out.elements.push_back(element);
            continue;
        }
        if (first[k + 1] - first[k] != nodes_of(element.kind)) {
            throw std::runtime_error(fmt::format("{}: cell {} has {} points where {} are expected", file, k + 1, first[k + 1] - first[k],
                                                 nodes_of(element.kind)));
        }
        for (std::size_t c = 0; c < nodes_of(element.kind); ++c) {
            const std::size_t at = first[k] + c;
            const double id = point->GetComponent(static_cast<vtkIdType>(at), 0);
            if (!(id >= 0.0 && id < static_cast<double>(out.node.size()))) {
                throw std::runtime_error(fmt::format("{}: cell {} has point {}, and there are {}", file, k + 1, id, out.node.size()));
            }
            element.node[c] = static_cast<std::uint32_t>(id);
        }
        out.elements.push_back(element);
    }
}

} // namespace

Content read_vtk(const std::string& file, bool legacy) {
    vtkSmartPointer<vtkUnstructuredGrid> grid;
    if (legacy) {
        LegacyCheck(file).run();
        grid = read_with<vtkUnstructuredGridReader>(file);
    } else {
        check_counts(file);
        grid = read_with<vtkXMLUnstructuredGridReader>(file);
    }
    if (grid->GetNumberOfPoints() >= static_cast<vtkIdType>(no_node)) {
        throw std::runtime_error(file + ": too many points");
    }
    Content out;
    add_points(*grid, out);
    add_cells(*grid, file, out);
    return out;
}

} // namespace proveta::solid_files
