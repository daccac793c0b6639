// Surfaces of STL files. VTK's reader of them makes room for as many faces as four bytes say, which text may be taken for.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "core/input/text_file.hpp"
#include "core/input/words.hpp"
#include "specimens/solid_content.hpp"
#include "specimens/surface_content.hpp"

namespace proveta::surface_files {

namespace {

using input::blanks;
using input::shown;
using solid_files::parse;

constexpr std::size_t head = 84; // of a binary file: a title and the number of faces
constexpr std::size_t face = 50; // its normal, its corners and two bytes more, in which some programs keep a colour

// Four bytes, lowest first.
std::uint32_t word_at(std::string_view bytes, std::size_t at) {
    std::uint32_t out = 0;
    for (std::size_t k = 4; k > 0; --k) {
        out = out << 8U | static_cast<unsigned char>(bytes[at + k - 1]);
    }
    return out;
}

Faces read_binary(std::string_view bytes, const std::string& file) {
    const std::size_t n = word_at(bytes, head - 4);
    const std::size_t left = bytes.size() - head;
    if (n > left / face) {
        refuse(file, {fmt::format("{} faces are announced, which take {} bytes, and the file has {}: it is cut short in face {}", n,
                                  head + face * n, bytes.size(), left / face + 1)});
    }
    Faces out;
    const auto rest = bytes.substr(head + face * n);
    const bool filled_up = rest.find_first_not_of('\0') == std::string_view::npos;
    if (rest.size() >= face && !filled_up) {
        refuse(file, {fmt::format("{} faces are announced, and the file holds {} bytes more, as {} more faces would take: its number of "
                                  "faces is wrong, or what follows them is none",
                                  n, rest.size(), rest.size() / face)});
    }
    if (!rest.empty()) {
        out.notes.push_back(fmt::format("{} bytes behind the last face were passed over", rest.size()));
    }
    std::vector<std::string> problems;
    for (std::size_t f = 0; f < n; ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3 place;
            for (std::size_t c = 0; c < 3; ++c) {
                place[static_cast<Eigen::Index>(c)] = std::bit_cast<float>(word_at(bytes, head + face * f + 12 * (k + 1) + 4 * c));
            }
            if (!place.allFinite()) {
                problems.push_back(fmt::format("face {}: vertex {} is at {} {} {}", f + 1, k + 1, place.x(), place.y(), place.z()));
            }
            out.mesh.vertex.push_back(place);
        }
        const auto first = static_cast<std::uint32_t>(3 * f);
        out.mesh.add({first, first + 1, first + 2});
    }
    refuse(file, problems);
    return out;
}

// Facets as text: words in either case, between blanks of any kind; several solids, one after the other.
class TextFacets {
  public:
    TextFacets(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    Faces read() {
        bool open = false;
        while (next()) {
            if (word_ == "solid" && !open) {
                open = true;
                pass_over_line(); // the title
            } else if (word_ == "endsolid" && open) {
                open = false;
                pass_over_line();
            } else if (word_ == "facet" && open) {
                read_facet();
            } else if (word_ == "color" && open) {
                pass_over_line();
            } else {
                unexpected(open ? "facet or endsolid" : "solid");
            }
        }
        if (open) {
            unexpected("endsolid");
        }
        refuse(file_, problems_);
        return std::move(out_);
    }

  private:
    // The next word in lower case; empty at the end, which is in the line of the last word.
    bool next() {
        const std::size_t from = std::min(text_.find_first_not_of(blanks, at_), text_.size());
        if (from == text_.size()) {
            word_.clear();
            return false;
        }
        for (; at_ < from; ++at_) {
            line_ += text_[at_] == '\n' || (text_[at_] == '\r' && text_.substr(at_ + 1, 1) != "\n") ? 1 : 0;
        }
        at_ = std::min(text_.find_first_of(blanks, from), text_.size());
        found_ = text_.substr(from, at_ - from);
        word_ = input::lower_case(found_);
        return true;
    }
    void pass_over_line() { at_ = std::min(text_.find_first_of("\r\n", at_), text_.size()); }
    void problem(std::size_t line, const std::string& what) { problems_.push_back(fmt::format("line {}: {}", line, what)); }
    [[noreturn]] void unexpected(const std::string& expected) {
        problem(line_, word_.empty() ? fmt::format("the file ends before {}, in or after facet {}: it is cut short", expected, facets_)
                                     : fmt::format("{} is expected after facet {} and {} was found", expected, facets_, shown(found_)));
        refuse(file_, problems_);
        throw std::logic_error("a refusal without a problem");
    }
    void expect(const char* word) {
        if (!next() || word_ != word) {
            unexpected(word);
        }
    }

    void read_facet() {
        ++facets_;
        const std::size_t line = line_;
        // Its normal follows from its corners.
        for (int k = 0; next() && word_ != "outer"; ++k) {
            if (k == 4) {
                break;
            }
        }
        if (word_ != "outer") {
            unexpected("outer loop");
        }
        expect("loop");
        std::vector<Vec3> corner;
        while (next() && word_ == "vertex") {
            corner.push_back(read_vertex(corner.size() + 1));
        }
        if (word_ != "endloop") {
            unexpected("vertex or endloop");
        }
        expect("endfacet");
        if (corner.size() != 3) {
            problem(line, fmt::format("facet {} has {} vertices, and those of STL have three", facets_, corner.size()));
            return;
        }
        const auto first = static_cast<std::uint32_t>(out_.mesh.vertex.size());
        out_.mesh.vertex.insert(out_.mesh.vertex.end(), corner.begin(), corner.end());
        out_.mesh.add({first, first + 1, first + 2});
        out_.line.push_back(line);
    }
    Vec3 read_vertex(std::size_t number) {
        Vec3 place;
        for (double& x : place) {
            if (!next() || !parse(found_, x)) {
                unexpected(fmt::format("a coordinate of vertex {} of the facet", number));
            }
            if (!std::isfinite(x)) {
                problem(line_, fmt::format("vertex {} of facet {}: {} is no finite number", number, facets_, shown(found_)));
            }
        }
        return place;
    }

    std::string_view text_;
    std::string file_;
    std::size_t at_ = 0;
    std::size_t line_ = 1;
    std::string_view found_;
    std::string word_;
    std::size_t facets_ = 0; // that have begun
    std::vector<std::string> problems_;
    Faces out_;
};

// A binary file's number of faces has a byte that no text has, as long as it is not beyond what is read; its title may be anything.
bool is_text(std::string_view text) {
    const std::string first = input::lower_case(input::trimmed(text).substr(0, 5));
    return (first == "solid" || first == "facet") && text.substr(0, head + face).find('\0') == std::string_view::npos;
}

} // namespace

Faces read_stl(const std::string& file) {
    std::string bytes = solid_files::bytes_of(file);
    if (bytes.size() >= head && bytes.size() == head + face * static_cast<std::size_t>(word_at(bytes, head - 4))) {
        return read_binary(bytes, file); // no text of this length has that number there
    }
    bytes = input::as_utf8(std::move(bytes), file);
    const auto text = std::string_view(bytes).substr(0, bytes.find_last_not_of(std::string_view("\0\x1a", 2)) + 1); // what fills it up
    if (is_text(text)) {
        return TextFacets(text, file).read();
    }
    const auto printed = [](char c) { return static_cast<unsigned char>(c) >= ' ' || blanks.find(c) != std::string_view::npos; };
    if (bytes.size() < head || std::all_of(bytes.begin(), bytes.begin() + head, printed)) {
        refuse(file,
               {fmt::format("neither text, which begins with solid, nor binary, which has a head of {} bytes and a number of faces: it "
                            "has {} bytes and begins with {}",
                            head, bytes.size(), shown(bytes))});
    }
    return read_binary(bytes, file);
}

} // namespace proveta::surface_files
