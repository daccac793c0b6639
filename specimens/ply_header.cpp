#include "specimens/ply_header.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <stdexcept>

#include "core/input/words.hpp"
#include "specimens/solid_content.hpp"

namespace proveta::surface_files {

namespace {

using input::shown;

const std::map<std::string_view, PlyType> types{
    {"char", PlyType::int8},     {"int8", PlyType::int8},       {"uchar", PlyType::uint8},    {"uint8", PlyType::uint8},
    {"short", PlyType::int16},   {"int16", PlyType::int16},     {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},
    {"int", PlyType::int32},     {"int32", PlyType::int32},     {"uint", PlyType::uint32},    {"uint32", PlyType::uint32},
    {"float", PlyType::float32}, {"float32", PlyType::float32}, {"double", PlyType::float64}, {"float64", PlyType::float64}};

class HeaderReader {
  public:
    HeaderReader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    PlyHeader read() {
        if (const auto first = line(); first.size() != 1 || input::lower_case(first[0]) != "ply") {
            fail("ply is expected in the first line");
        }
        bool format = false;
        for (auto words = line(); words.empty() || words[0] != "end_header"; words = line()) {
            const std::string word = words.empty() ? "comment" : input::lower_case(words[0]);
            if (word == "comment" || word == "obj_info") {
                continue;
            }
            if (word == "format" && words.size() >= 2) {
                read_format(words);
                format = true;
            } else if (word == "element" && words.size() == 3) {
                read_element(words);
            } else if (word == "property" && !out_.elements.empty()) {
                read_property(words);
            } else {
                fail(fmt::format("{} is not understood in the header", shown(words[0])));
            }
        }
        if (!format) {
            fail("the header has no line \"format\", such as format ascii 1.0");
        }
        check_elements();
        out_.end = at_;
        return std::move(out_);
    }

  private:
    [[noreturn]] void fail(const std::string& what) const { throw std::runtime_error(fmt::format("{}:{}: {}", file_, out_.lines, what)); }

    // Lines end in "\r" only where the first one does: what follows the header may begin with any byte.
    std::vector<std::string_view> line() {
        if (at_ >= text_.size()) {
            fail("the file ends before end_header");
        }
        const std::size_t first = std::min(text_.find_first_of("\r\n"), text_.size());
        const bool returns = text_.substr(first, 1) == "\r" && text_.substr(first, 2) != "\r\n";
        const std::size_t end = std::min(text_.find(returns ? '\r' : '\n', at_), text_.size());
        const auto whole = text_.substr(at_, end - at_);
        at_ = std::min(end + 1, text_.size());
        ++out_.lines;
        return input::words_of(whole);
    }
    [[nodiscard]] PlyType type_of(std::string_view word) const {
        const auto found = types.find(input::lower_case(word));
        if (found == types.end()) {
            fail(fmt::format("{} is no type of a property: char, uchar, short, ushort, int, uint, float or double", shown(word)));
        }
        return found->second;
    }
    void read_format(const std::vector<std::string_view>& words) {
        const std::string form = input::lower_case(words[1]);
        if (form != "ascii" && form != "binary_little_endian" && form != "binary_big_endian") {
            fail(fmt::format("the format {} is none of ascii, binary_little_endian and binary_big_endian", shown(words[1])));
        }
        if (words.size() != 3 || words[2] != "1.0") {
            fail(fmt::format("version 1.0 is expected and {} was found", words.size() == 3 ? shown(words[2]) : "none"));
        }
        out_.binary = form != "ascii";
        out_.turned = form == (std::endian::native == std::endian::little ? "binary_big_endian" : "binary_little_endian");
    }
    void read_element(const std::vector<std::string_view>& words) {
        PlyElement& kind = out_.elements.emplace_back();
        kind.name = input::lower_case(words[1]);
        if (!solid_files::parse(words[2], kind.number) || kind.number > text_.size() - at_) {
            fail(fmt::format("{} {} are announced, which a file of {} bytes cannot hold", shown(words[2]), shown(words[1]), text_.size()));
        }
        if (kind.name == "vertex") {
            out_.vertices = kind.number;
        }
        const auto same = [&](const PlyElement& other) { return other.name == kind.name; };
        if (std::count_if(out_.elements.begin(), out_.elements.end(), same) > 1) {
            fail(fmt::format("a second element {}", shown(words[1])));
        }
    }
    void read_property(const std::vector<std::string_view>& words) {
        const bool list = words.size() == 5 && input::lower_case(words[1]) == "list";
        if (!list && words.size() != 3) {
            fail("a property needs a type and a name, one of a list two types behind \"list\" and a name");
        }
        PlyElement& kind = out_.elements.back();
        PlyProperty p;
        p.name = input::lower_case(words.back());
        p.type = type_of(words[words.size() - 2]);
        p.list = list;
        p.count = list ? type_of(words[2]) : p.count;
        const auto axis = std::string_view("xyz").find(p.name);
        if (!list && p.name.size() == 1 && axis != std::string_view::npos) {
            p.axis = static_cast<int>(axis);
        }
        p.vertices = list && (kind.name == "face" || kind.name == "tristrips") &&
                     (p.name == "vertex_indices" || p.name == "vertex_index" || p.name == "vertex_indexes");
        if (p.vertices && std::any_of(kind.properties.begin(), kind.properties.end(), [](const auto& other) { return other.vertices; })) {
            fail(fmt::format("a second list of vertices, {}", shown(words.back())));
        }
        kind.properties.push_back(p);
    }

    // What cannot be made faces of.
    void check_elements() const {
        bool faces = false;
        std::vector<std::string> found;
        for (const PlyElement& kind : out_.elements) {
            std::array<bool, 3> axes{};
            bool lists = false;
            std::vector<std::string> names;
            for (const PlyProperty& p : kind.properties) {
                names.push_back(p.name);
                lists = lists || p.vertices;
                if (p.axis) {
                    axes[static_cast<std::size_t>(*p.axis)] = true;
                }
            }
            const std::string whole = fmt::format("{} ({})", kind.name, fmt::join(names, ", "));
            if (kind.name == "vertex" && kind.number > 0 && std::count(axes.begin(), axes.end(), true) < 3) {
                fail(fmt::format("a vertex needs the properties x, y and z, and this has {}", whole));
            }
            faces = faces || (lists && kind.number > 0);
            found.push_back(fmt::format("{} {}", kind.number, whole));
        }
        if (!faces) {
            fail(fmt::format("holds no faces: those of an element face, or of tristrips, by a list vertex_index, vertex_indices or "
                             "vertex_indexes are read; there are {}",
                             found.empty() ? "no elements" : fmt::format("{}", fmt::join(found, ", "))));
        }
    }

    std::string_view text_;
    std::string file_;
    std::size_t at_ = 0;
    PlyHeader out_;
};

} // namespace

PlyHeader read_ply_header(std::string_view text, const std::string& file) { return HeaderReader(text, file).read(); }

} // namespace proveta::surface_files
