#include "specimens/stl_import.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "specimens/solid_content.hpp"

namespace proveta {

namespace {

using solid_files::parse;
using solid_files::shown;
using solid_files::space;

constexpr std::size_t head = 84; // of a binary file: a title and the number of faces
constexpr std::size_t face = 50; // its normal, its corners and two bytes more

// Four bytes, lowest first.
std::uint32_t word_at(const std::string& text, std::size_t at) {
    std::uint32_t out = 0;
    for (std::size_t k = 4; k > 0; --k) {
        out = out << 8U | static_cast<unsigned char>(text[at + k - 1]);
    }
    return out;
}

// Titles of binary files may begin like a text, too; their size tells them apart.
bool is_binary(const std::string& text) {
    return text.size() >= head &&
           (!text.starts_with("solid") || text.size() == head + face * static_cast<std::size_t>(word_at(text, head - 4)));
}

void read_binary(const std::string& text, vtkPoints& points, const std::string& file) {
    const std::size_t n = word_at(text, head - 4);
    if (n > (text.size() - head) / face) {
        throw std::runtime_error(fmt::format("{}: {} faces are announced, which a file of {} bytes cannot hold", file, n, text.size()));
    }
    for (std::size_t k = 0; k < 3 * n; ++k) {
        float place[3];
        for (std::size_t c = 0; c < 3; ++c) {
            place[c] = std::bit_cast<float>(word_at(text, head + face * (k / 3) + 12 * (k % 3 + 1) + 4 * c));
        }
        points.InsertNextPoint(place);
    }
}

void read_text(const std::string& text, vtkPoints& points, const std::string& file) {
    std::size_t at = 0;
    const auto word = [&] {
        const std::size_t from = std::min(text.find_first_not_of(space, at), text.size());
        at = std::min(text.find_first_of(space, from), text.size());
        return std::string_view(text).substr(from, at - from);
    };
    for (std::string_view next = word(); !next.empty(); next = word()) {
        if (next != "vertex" && next != "VERTEX") {
            continue;
        }
        double place[3];
        for (double& x : place) {
            if (const std::string_view found = word(); !parse(found, x)) {
                throw std::runtime_error(fmt::format("{}: vertex {}: a coordinate is expected and {} was found", file,
                                                     points.GetNumberOfPoints() + 1, found.empty() ? "the end of the file" : shown(found)));
            }
        }
        points.InsertNextPoint(place);
    }
    if (points.GetNumberOfPoints() % 3 != 0) {
        throw std::runtime_error(fmt::format("{}: {} vertices do not make triangles", file, points.GetNumberOfPoints()));
    }
}

} // namespace

vtkSmartPointer<vtkPolyData> read_stl(const std::string& file) {
    const std::string text = solid_files::text_of(file);
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    is_binary(text) ? read_binary(text, *points, file) : read_text(text, *points, file);
    vtkNew<vtkCellArray> faces;
    for (vtkIdType k = 0; k < points->GetNumberOfPoints(); k += 3) {
        const vtkIdType corners[] = {k, k + 1, k + 2};
        faces->InsertNextCell(3, corners);
    }
    auto out = vtkSmartPointer<vtkPolyData>::New();
    out->SetPoints(points);
    out->SetPolys(faces);
    return out;
}

} // namespace proveta
