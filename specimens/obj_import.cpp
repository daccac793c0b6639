#include "specimens/obj_import.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "specimens/solid_content.hpp"

namespace proveta {

namespace {

using solid_files::parse;
using solid_files::shown;

// The lines of a text. One that ends in a backslash goes on in the next, and stands there whole.
std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> out;
    std::string begun;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        begun.append(text, at, end - at);
        at = end + 1;
        begun.resize(begun.find_last_not_of(" \t\r") + 1);
        if (!begun.empty() && begun.back() == '\\') {
            begun.back() = ' ';
            out.emplace_back();
        } else {
            out.push_back(std::move(begun));
            begun.clear();
        }
    }
    return out;
}

} // namespace

vtkSmartPointer<vtkPolyData> read_obj(const std::string& file) {
    const auto lines = lines_of(solid_files::text_of(file));
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> faces;
    std::vector<std::pair<std::vector<long long>, std::size_t>> corners; // of each face, from 1, and its line
    const auto fail = [&](std::size_t line, const std::string& what) {
        throw std::runtime_error(fmt::format("{}:{}: {}", file, line, what));
    };
    for (std::size_t k = 0; k < lines.size(); ++k) {
        const auto words = solid_files::words_of(std::string_view(lines[k]).substr(0, lines[k].find('#')));
        if (words.empty() || (words[0] != "v" && words[0] != "f")) {
            continue;
        }
        if (words[0] == "v") {
            double place[3];
            for (std::size_t c = 0; c < 3; ++c) {
                if (c + 1 >= words.size() || !parse(words[c + 1], place[c])) {
                    fail(k + 1, "a vertex has no three coordinates");
                }
            }
            points->InsertNextPoint(place);
            continue;
        }
        auto& [face, line] = corners.emplace_back();
        line = k + 1;
        for (std::size_t c = 1; c < words.size(); ++c) {
            long long number = 0;
            if (!parse(words[c].substr(0, words[c].find('/')), number) || number == 0) {
                fail(line, fmt::format("{} is no vertex", shown(words[c])));
            }
            face.push_back(number < 0 ? points->GetNumberOfPoints() + 1 + std::max(number, -1LL << 40) : number); // from the last
        }
    }
    for (const auto& [face, line] : corners) {
        faces->InsertNextCell(static_cast<int>(face.size()));
        for (const long long number : face) {
            if (number < 1 || number > points->GetNumberOfPoints()) {
                fail(line, fmt::format("vertex {} of a face is not there", number));
            }
            faces->InsertCellPoint(number - 1);
        }
    }
    auto out = vtkSmartPointer<vtkPolyData>::New();
    out->SetPoints(points);
    out->SetPolys(faces);
    return out;
}

} // namespace proveta
