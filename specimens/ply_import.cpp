#include "specimens/ply_import.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <stdexcept>
#include <vector>

#include "specimens/solid_content.hpp"

namespace proveta {

namespace {

using solid_files::parse;
using solid_files::shown;
using solid_files::space;

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

const std::map<std::string_view, Type> types{
    {"char", Type::int8},     {"int8", Type::int8},       {"uchar", Type::uint8},    {"uint8", Type::uint8},
    {"short", Type::int16},   {"int16", Type::int16},     {"ushort", Type::uint16},  {"uint16", Type::uint16},
    {"int", Type::int32},     {"int32", Type::int32},     {"uint", Type::uint32},    {"uint32", Type::uint32},
    {"float", Type::float32}, {"float32", Type::float32}, {"double", Type::float64}, {"float64", Type::float64}};

struct Property {
    std::string name;
    Type type = Type::float32;
    bool list = false;
    Type count = Type::uint8; ///< of a list
};

struct ElementKind {
    std::string name;
    std::size_t number = 0;
    std::vector<Property> properties;
};

class Ply {
  public:
    explicit Ply(const std::string& file) : file_(file), text_(solid_files::text_of(file)) {
        points_->SetDataTypeToDouble();
        read_header();
    }

    vtkSmartPointer<vtkPolyData> read() {
        for (const ElementKind& kind : kinds_) {
            for (std::size_t k = 0; k < kind.number && !kind.properties.empty(); ++k) {
                read_element(kind);
            }
        }
        auto out = vtkSmartPointer<vtkPolyData>::New();
        out->SetPoints(points_);
        out->SetPolys(faces_);
        return out;
    }

  private:
    [[noreturn]] void fail(const std::string& what) const { throw std::runtime_error(file_ + ": " + what); }
    [[nodiscard]] std::size_t left() const { return text_.size() - at_; }

    std::vector<std::string_view> line() {
        if (at_ >= text_.size()) {
            fail("the file ends before end_header");
        }
        const std::size_t end = std::min(text_.find('\n', at_), text_.size());
        const std::string_view whole = std::string_view(text_).substr(at_, end - at_);
        at_ = std::min(end + 1, text_.size());
        return solid_files::words_of(whole);
    }
    [[nodiscard]] Type type_of(std::string_view word) const {
        const auto found = types.find(word);
        if (found == types.end()) {
            fail(fmt::format("{} is no type of a property", shown(word)));
        }
        return found->second;
    }

    void read_header() {
        if (const auto first = line(); first.size() != 1 || first[0] != "ply") {
            fail("ply is expected in the first line");
        }
        for (auto words = line(); words.empty() || words[0] != "end_header"; words = line()) {
            if (words.empty() || words[0] == "comment" || words[0] == "obj_info") {
                continue;
            }
            if (words[0] == "format" && words.size() == 3) {
                binary_ = words[1] != "ascii";
                turned_ = words[1] == (std::endian::native == std::endian::little ? "binary_big_endian" : "binary_little_endian");
            } else if (words[0] == "element" && words.size() == 3) {
                ElementKind& kind = kinds_.emplace_back();
                kind.name = words[1];
                if (!parse(words[2], kind.number) || kind.number > left()) {
                    fail(fmt::format("{} {} are announced, which a file of {} bytes cannot hold", shown(words[2]), shown(words[1]),
                                     text_.size()));
                }
            } else if (words[0] == "property" && words.size() == 3 && !kinds_.empty()) {
                kinds_.back().properties.push_back({std::string(words[2]), type_of(words[1])});
            } else if (words[0] == "property" && words.size() == 5 && words[1] == "list" && !kinds_.empty()) {
                kinds_.back().properties.push_back({std::string(words[4]), type_of(words[3]), true, type_of(words[2])});
            } else {
                fail(fmt::format("{} is not understood in the header", shown(words[0])));
            }
        }
    }

    template <class Number> double binary() {
        if (left() < sizeof(Number)) {
            fail("the file ends too early");
        }
        char bytes[sizeof(Number)];
        std::copy_n(text_.data() + at_, sizeof(Number), bytes);
        at_ += sizeof(Number);
        if (turned_) {
            std::reverse(std::begin(bytes), std::end(bytes));
        }
        Number value;
        std::memcpy(&value, bytes, sizeof value);
        return static_cast<double>(value);
    }
    double number(Type type) {
        if (binary_) {
            switch (type) {
            case Type::int8: return binary<std::int8_t>();
            case Type::uint8: return binary<std::uint8_t>();
            case Type::int16: return binary<std::int16_t>();
            case Type::uint16: return binary<std::uint16_t>();
            case Type::int32: return binary<std::int32_t>();
            case Type::uint32: return binary<std::uint32_t>();
            case Type::float32: return binary<float>();
            case Type::float64: return binary<double>();
            }
        }
        const std::size_t from = std::min(text_.find_first_not_of(space, at_), text_.size());
        at_ = std::min(text_.find_first_of(space, from), text_.size());
        const auto word = std::string_view(text_).substr(from, at_ - from);
        double value = 0.0;
        if (!parse(word, value)) {
            fail(word.empty() ? "the file ends too early" : fmt::format("a number is expected and {} was found", shown(word)));
        }
        return value;
    }
    // A number of values to come or of a vertex: whole, and below a bound.
    std::size_t whole(Type type, std::size_t below, const char* what) {
        const double value = number(type);
        if (!(value >= 0.0 && value < static_cast<double>(below)) || value != std::floor(value)) {
            fail(fmt::format("{} is {}, which there cannot be", what, value));
        }
        return static_cast<std::size_t>(value);
    }

    void read_element(const ElementKind& kind) {
        double place[3] = {0.0, 0.0, 0.0};
        for (const Property& p : kind.properties) {
            const bool face = p.list && kind.name == "face" && (p.name == "vertex_indices" || p.name == "vertex_index");
            const std::size_t values = p.list ? whole(p.count, left() + 1, "the length of a list") : 1;
            if (face) {
                faces_->InsertNextCell(static_cast<int>(values));
            }
            for (std::size_t k = 0; k < values; ++k) {
                if (face) {
                    faces_->InsertCellPoint(static_cast<vtkIdType>(
                        whole(p.type, static_cast<std::size_t>(points_->GetNumberOfPoints()), "a vertex of a face")));
                    continue;
                }
                const double value = number(p.type);
                if (!p.list && p.name.size() == 1 && p.name[0] >= 'x' && p.name[0] <= 'z') {
                    place[p.name[0] - 'x'] = value;
                }
            }
        }
        if (kind.name == "vertex") {
            points_->InsertNextPoint(place);
        }
    }

    std::string file_;
    std::string text_;
    std::size_t at_ = 0;
    bool binary_ = false;
    bool turned_ = false; // bytes are in the other order than this machine's
    std::vector<ElementKind> kinds_;
    vtkNew<vtkPoints> points_;
    vtkNew<vtkCellArray> faces_;
};

} // namespace

vtkSmartPointer<vtkPolyData> read_ply(const std::string& file) { return Ply(file).read(); }

} // namespace proveta
