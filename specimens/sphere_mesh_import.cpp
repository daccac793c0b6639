#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "core/input/text_file.hpp"
#include "core/input/words.hpp"
#include "specimens/memory.hpp"
#include "specimens/sphere_file.hpp"

namespace proveta {

namespace {

using input::lower_case;
using input::shown;

// Splits a line at commas, semicolons and white space.
std::vector<std::string> fields(std::string_view line) {
    std::vector<std::string> out;
    std::size_t at = 0;
    while (at < line.size()) {
        const auto end = std::min(line.find_first_of(", ;\t", at), line.size());
        if (end > at) {
            out.emplace_back(line.substr(at, end - at));
        }
        at = end + 1;
    }
    return out;
}

// A text file read line by line, which knows where it is.
class Lines {
  public:
    Lines(const std::string& file, std::string text)
        : file_(file), text_(input::as_utf8(std::move(text), file)), lines_(input::lines_of(text_)) {}
    Lines(const Lines&) = delete;
    Lines& operator=(const Lines&) = delete;

    bool next(std::string_view& line) {
        if (number_ == lines_.size()) {
            return false;
        }
        line = lines_[number_++];
        return true;
    }
    [[nodiscard]] std::size_t number() const { return number_; }
    [[noreturn]] void fail(const std::string& what) const { throw std::runtime_error(fmt::format("{}:{}: {}", file_, number_, what)); }
    // A line has too few or too many fields, as those with decimal commas have, which would be taken for separators.
    void need(bool right, const std::string& what) const {
        if (!right) {
            const auto line = lines_[number_ - 1];
            const bool points = line.find(',') == line.npos || line.find('.') != line.npos;
            fail(fmt::format("{}{}, in {}", what, points ? "" : ", with decimal points and not commas", shown(line)));
        }
    }
    double real(const std::string& text) const {
        double x = 0.0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
        if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(x)) {
            fail(shown(text) + " is not a finite number");
        }
        return x;
    }

    // A number of a node or a group.
    int whole(const std::string& text) const {
        const double x = real(text);
        if (x != std::floor(x) || std::fabs(x) > std::numeric_limits<int>::max()) {
            fail(shown(text) + " is no number of a node or a group");
        }
        return static_cast<int>(x);
    }

    double radius(const std::string& text) const {
        const double value = real(text);
        if (value <= 0.0) {
            fail("radius " + text + " is not positive");
        }
        return value;
    }

  private:
    std::string file_;
    std::string text_;
    std::vector<std::string_view> lines_;
    std::size_t number_ = 0; // of the line that was taken last
};

using Nodes = std::map<int, ReadSphere>;

// The same may be said twice of a node. What contradicts what was said before; empty where nothing does.
std::string put_node(Nodes& nodes, int id, const Vec3& centre) {
    const auto [node, is_new] = nodes.try_emplace(id);
    if (!is_new && node->second.centre != centre) {
        return fmt::format("a second node {} in another place", id);
    }
    node->second.centre = centre;
    return "";
}

std::string put_radius(Nodes& nodes, int id, double radius) {
    const auto node = nodes.find(id);
    if (node == nodes.end()) {
        return fmt::format("node {} was not declared", id);
    }
    double& r = node->second.radius;
    if (r > 0.0 && r != radius) {
        return fmt::format("a second radius of node {}, {:.6g} after {:.6g}", id, radius, r);
    }
    r = radius;
    return "";
}

void refuse(const Lines& in, const std::string& problem) {
    if (!problem.empty()) {
        in.fail(problem);
    }
}

// In the order of the nodes' numbers. Nodes in `others` are not spheres'.
ReadSpheres in_order(const std::string& file, const Nodes& nodes, const std::set<int>& others) {
    ReadSpheres out;
    out.numbered = "node";
    std::vector<std::string> without;
    for (const auto& [id, sphere] : nodes) {
        if (sphere.radius > 0.0) {
            out.spheres.push_back(sphere);
            out.spheres.back().number = id;
        } else if (others.count(id) == 0) {
            without.push_back(fmt::format("{}", id));
        }
    }
    if (!without.empty()) {
        throw std::runtime_error(
            fmt::format("{}: {} of {} nodes have no radius: {}", file, without.size(), nodes.size(), input::first_few(without)));
    }
    return out;
}

ReadSpheres read_gid_text(const std::string& file, std::string text) {
    Lines in(file, std::move(text));
    Nodes nodes;
    std::set<int> others;
    std::vector<std::string> passed_over;
    std::string_view line;
    std::string block;
    bool spheres = false;
    while (in.next(line)) {
        const auto f = fields(line.substr(0, line.find('#')));
        if (f.empty()) {
            continue;
        }
        const std::string first = lower_case(f[0]);
        if (first == "mesh" || first == "coordinates" || first == "elements") {
            if (!block.empty()) {
                in.fail(fmt::format("{} before \"end {}\"", shown(f[0]), block));
            }
            const std::string words = lower_case(line);
            spheres = first == "mesh" ? words.find("sphere") != std::string::npos || words.find("circle") != std::string::npos : spheres;
            block = first == "mesh" ? "" : first;
        } else if (first == "end") {
            if (block.empty() || f.size() < 2 || lower_case(f[1]) != block) {
                in.fail(shown(line) + " closes no block that is open");
            }
            block.clear();
        } else if (block == "coordinates") {
            in.need(f.size() == 3 || f.size() == 4, "a node needs its number and two or three coordinates");
            refuse(in, put_node(nodes, in.whole(f[0]), {in.real(f[1]), in.real(f[2]), f.size() > 3 ? in.real(f[3]) : 0.0}));
        } else if (block == "elements" && !spheres) {
            for (std::size_t k = 1; k < f.size(); ++k) {
                others.insert(in.whole(f[k]));
            }
        } else if (block == "elements") {
            in.need(f.size() == 3 || f.size() == 4, "a sphere element needs number, node, radius and at most a material");
            refuse(in, put_radius(nodes, in.whole(f[1]), in.radius(f[2])));
        } else {
            passed_over.push_back(fmt::format("{}", in.number()));
        }
    }
    if (!block.empty()) {
        in.fail("the file ends before \"end " + block + "\": it is cut short");
    }
    ReadSpheres out = in_order(file, nodes, others);
    if (!passed_over.empty()) {
        out.warnings.push_back(fmt::format("{} lines outside Coordinates and Elements were passed over: {}", passed_over.size(),
                                           input::first_few(passed_over)));
    }
    return out;
}

// Header: five int32: 3 (dimensions), 9 (spheres), 1 (node an element), nodes, elements. Nodes of 56 bytes: number at +0, x, y, z as
// doubles at +32. Four bytes. Elements of 44 bytes: number at +0, node at +32, radius as double at +36.
constexpr std::size_t gid_header = 20;
constexpr std::size_t gid_node = 56;
constexpr std::size_t gid_element = 44;

template <class T> T value_at(const std::string& bytes, std::size_t at) {
    static_assert(std::endian::native == std::endian::little, "GiD's files are little-endian");
    T out;
    std::memcpy(&out, bytes.data() + at, sizeof(T));
    return out;
}

bool is_gid_binary(const std::string& bytes) {
    return bytes.size() >= gid_header && value_at<std::int32_t>(bytes, 0) == 3 && value_at<std::int32_t>(bytes, 4) == 9 &&
           value_at<std::int32_t>(bytes, 8) == 1;
}

ReadSpheres read_gid_binary(const std::string& file, const std::string& bytes) {
    const auto fail = [&](const std::string& what) { throw std::runtime_error(file + ": " + what); };
    const auto announced = [&](std::size_t at) {
        const auto number = value_at<std::int32_t>(bytes, at);
        if (number < 0) {
            fail(fmt::format("{} nodes or spheres are announced", number));
        }
        return static_cast<std::size_t>(number);
    };
    const std::size_t count = announced(12);
    const std::size_t elements = announced(16);
    const std::size_t first = gid_header + count * gid_node + 4;
    const std::size_t end = first + elements * gid_element;
    if (bytes.size() < end) {
        fail(fmt::format("{} nodes and {} spheres are announced, which take {} bytes, and the file has {}: it is cut short", count,
                         elements, end, bytes.size()));
    }
    const auto refuse_if = [&](std::size_t sphere, const std::string& problem) {
        if (!problem.empty()) {
            fail(fmt::format("sphere {}: {}", value_at<std::int32_t>(bytes, sphere), problem));
        }
    };
    Nodes nodes;
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t at = gid_header + k * gid_node;
        const auto id = value_at<std::int32_t>(bytes, at);
        Vec3 centre;
        for (int c = 0; c < 3; ++c) {
            centre[c] = value_at<double>(bytes, at + 32 + 8 * static_cast<std::size_t>(c));
        }
        if (!centre.allFinite()) {
            fail(fmt::format("node {} has a coordinate that is not finite", id));
        }
        if (const std::string problem = put_node(nodes, id, centre); !problem.empty()) {
            fail(problem);
        }
    }
    for (std::size_t k = 0; k < elements; ++k) {
        const std::size_t at = first + k * gid_element;
        const double radius = value_at<double>(bytes, at + 36);
        if (!(radius > 0.0) || !std::isfinite(radius)) {
            refuse_if(at, fmt::format("radius {:.6g} is not positive", radius));
        }
        refuse_if(at, put_radius(nodes, value_at<std::int32_t>(bytes, at + 32), radius));
    }
    ReadSpheres out = in_order(file, nodes, {});
    if (bytes.find_first_not_of('\0', end) != std::string::npos) {
        out.warnings.push_back(fmt::format("{} bytes behind the last sphere were passed over", bytes.size() - end));
    }
    return out;
}

} // namespace

ReadSpheres read_mdpa(const std::string& file) {
    require_file(file);
    Lines in(file, input::read_text(file, largest_file));
    Nodes nodes;
    std::string_view line;
    std::vector<std::string> open; // blocks that have begun, each within the one before
    const auto name = [&] { return open.back().substr(0, open.back().find(' ')); };
    while (in.next(line)) {
        const auto f = fields(line.substr(0, line.find("//")));
        if (f.empty()) {
            continue;
        }
        const std::string first = lower_case(f[0]);
        const std::string block = open.empty() ? "" : lower_case(open.back());
        if (first == "begin" && f.size() > 1) {
            open.push_back(f[1] + (lower_case(f[1]) == "nodaldata" && f.size() > 2 ? " " + f[2] : ""));
        } else if (first == "end") {
            if (open.empty() || f.size() < 2 || lower_case(name()) != lower_case(f[1])) {
                in.fail(shown(line) + " closes no block that is open");
            }
            open.pop_back();
        } else if (block == "nodes") {
            in.need(f.size() == 4, "a node needs its number and three coordinates");
            refuse(in, put_node(nodes, in.whole(f[0]), {in.real(f[1]), in.real(f[2]), in.real(f[3])}));
        } else if (block == "nodaldata radius" || block == "nodaldata cohesive_group") {
            in.need(f.size() == 3, "a node's number, whether it is fixed, and a value are expected");
            const int id = in.whole(f[0]);
            if (block == "nodaldata radius") {
                refuse(in, put_radius(nodes, id, in.radius(f.back())));
            } else if (const auto node = nodes.find(id); node != nodes.end()) {
                node->second.group = in.whole(f.back());
            } else {
                in.fail(fmt::format("node {} was not declared", id));
            }
        }
    }
    if (!open.empty()) {
        in.fail("the file ends before \"End " + name() + "\": it is cut short");
    }
    return in_order(file, nodes, {});
}

ReadSpheres read_gid(const std::string& file) {
    require_file(file);
    std::string bytes = input::read_text(file, largest_file);
    if (bytes.starts_with('$')) {
        throw std::runtime_error(file + ": a mesh of Gmsh, which has no spheres; GiD's begin with MESH");
    }
    return is_gid_binary(bytes) ? read_gid_binary(file, bytes) : read_gid_text(file, std::move(bytes));
}

} // namespace proveta
