// Surfaces of OBJ files.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/input/words.hpp"
#include "specimens/solid_content.hpp"
#include "specimens/surface_content.hpp"

namespace proveta::surface_files {

namespace {

using input::shown;
using solid_files::parse;

struct Line {
    std::string text;
    std::size_t number; // of the first
};

// The lines of a text. One that ends in a backslash goes on in the next, and stands there whole.
std::vector<Line> whole_lines(const std::string& text) {
    std::vector<Line> out;
    bool goes_on = false;
    std::size_t number = 0;
    for (std::string_view line : input::lines_of(text)) {
        ++number;
        line = line.substr(0, line.find('#'));
        line = line.substr(0, line.find_last_not_of(input::blanks) + 1);
        const bool more = line.ends_with('\\');
        line.remove_suffix(more ? 1 : 0);
        if (goes_on) {
            out.back().text += " ";
            out.back().text += line;
        } else {
            out.push_back({std::string(line), number});
        }
        goes_on = more;
    }
    return out;
}

// What has nothing to do with where faces are: names, normals, textures, materials.
bool is_harmless(const std::string& word) {
    constexpr std::array words{"vn",     "vt",  "vp",     "g",     "o",        "s",        "mg",         "usemtl",   "mtllib",
                               "usemap", "lod", "maplib", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};
    return std::find(words.begin(), words.end(), word) != words.end();
}

class ObjReader {
  public:
    explicit ObjReader(const std::string& file) : file_(file) {}

    Faces read() {
        for (const Line& line : whole_lines(solid_files::text_of(file_))) {
            const auto words = input::words_of(line.text);
            const std::string word = words.empty() ? "" : input::lower_case(words[0]);
            if (word == "v") {
                read_vertex(words, line.number);
            } else if (word == "f" || word == "fo") {
                read_face(words, line.number);
            } else if (!word.empty() && !is_harmless(word)) {
                ++passed_over_[std::string(words[0])];
            }
        }
        check_faces();
        refuse(file_, problems_);
        for (const auto& [word, lines] : passed_over_) {
            out_.notes.push_back(fmt::format("{} lines that begin with {} were passed over", lines, shown(word)));
        }
        return std::move(out_);
    }

  private:
    void problem(std::size_t line, const std::string& what) { problems_.push_back(fmt::format("line {}: {}", line, what)); }

    // A weight or a colour may follow.
    void read_vertex(const std::vector<std::string_view>& words, std::size_t line) {
        Vec3 place = Vec3::Zero();
        for (std::size_t c = 1; c <= 3; ++c) {
            double& x = place[static_cast<Eigen::Index>(c - 1)];
            if (c >= words.size() || !parse(words[c], x) || !std::isfinite(x)) {
                problem(line, fmt::format("vertex {} has no three coordinates that are finite numbers: {}", out_.mesh.vertex.size() + 1,
                                          c < words.size() ? shown(words[c]) + " was found" : "the line ends"));
                break;
            }
        }
        out_.mesh.vertex.push_back(place);
    }
    // Vertices count from 1, or backwards from the last one that was read.
    void read_face(const std::vector<std::string_view>& words, std::size_t line) {
        if (words.size() < 4) {
            problem(line, fmt::format("a face of {} vertices", words.size() - 1));
            return;
        }
        std::vector<std::uint32_t> face;
        for (std::size_t c = 1; c < words.size(); ++c) {
            long long number = 0;
            if (!parse(words[c].substr(0, words[c].find('/')), number) || number == 0) {
                problem(line, fmt::format("{} is no vertex", shown(words[c])));
                return;
            }
            const auto last = static_cast<long long>(out_.mesh.vertex.size());
            const long long index = number < 0 ? last + std::max(number, -(1LL << 40)) : number - 1;
            if (index < 0 || index > static_cast<long long>(solid_files::no_node)) {
                problem(line, fmt::format("vertex {} of a face is not there", number));
                return;
            }
            face.push_back(static_cast<std::uint32_t>(index));
        }
        out_.mesh.add(face);
        out_.line.push_back(line);
    }
    // A face may come before its vertices.
    void check_faces() {
        const SurfaceMesh& mesh = out_.mesh;
        for (std::size_t f = 0; f < mesh.faces(); ++f) {
            const auto most = *std::max_element(mesh.corner.begin() + mesh.first[f], mesh.corner.begin() + mesh.first[f + 1]);
            if (most >= mesh.vertex.size()) {
                problem(out_.line[f], fmt::format("vertex {} of a face is not there: the file has {}", most + 1ULL, mesh.vertex.size()));
            }
        }
    }

    std::string file_;
    std::map<std::string, std::size_t> passed_over_; // lines of words that are not known
    std::vector<std::string> problems_;
    Faces out_;
};

} // namespace

Faces read_obj(const std::string& file) { return ObjReader(file).read(); }

} // namespace proveta::surface_files
