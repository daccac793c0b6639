#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "core/input/text_file.hpp"
#include "specimens/memory.hpp"
#include "specimens/sphere_file.hpp"

namespace proveta {

namespace {

// Splits a line at commas, semicolons and white space.
std::vector<std::string> fields(const std::string& line) {
    std::vector<std::string> out;
    std::size_t at = 0;
    while (at < line.size()) {
        const auto end = std::min(line.find_first_of(", ;\t\r", at), line.size());
        if (end > at) {
            out.push_back(line.substr(at, end - at));
        }
        at = end + 1;
    }
    return out;
}

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

// A text file read line by line, which knows where it is.
class Lines {
  public:
    Lines(const std::string& file, std::string text) : file_(file), in_(input::as_utf8(std::move(text), file)) {}
    bool next(std::string& line) {
        ++number_;
        return static_cast<bool>(std::getline(in_, line));
    }
    [[noreturn]] void fail(const std::string& what) const { throw std::runtime_error(fmt::format("{}:{}: {}", file_, number_, what)); }
    double real(const std::string& text) const {
        double x = 0.0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
        if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(x)) {
            fail("\"" + text.substr(0, 40) + "\" is not a finite number");
        }
        return x;
    }

    // A number of a node or a group.
    int whole(const std::string& text) const {
        const double x = real(text);
        if (x != std::floor(x) || std::fabs(x) > std::numeric_limits<int>::max()) {
            fail("\"" + text.substr(0, 40) + "\" is no number of a node or a group");
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
    std::istringstream in_;
    int number_ = 0;
};

using Nodes = std::map<int, ReadSphere>;

ReadSphere& declared(Nodes& nodes, const std::string& id, const Lines& in) {
    const auto at = nodes.find(in.whole(id));
    if (at == nodes.end()) {
        in.fail("node " + id + " was not declared");
    }
    return at->second;
}

// In the order of the nodes' numbers. Nodes in `others` are not spheres'.
ReadSpheres in_order(const std::string& file, const Nodes& nodes, const std::set<int>& others) {
    ReadSpheres out;
    std::vector<int> without;
    for (const auto& [id, sphere] : nodes) {
        if (sphere.radius > 0.0) {
            out.spheres.push_back(sphere);
            out.spheres.back().where = fmt::format("node {}", id);
        } else if (others.count(id) == 0) {
            without.push_back(id);
        }
    }
    if (!without.empty()) {
        const std::size_t shown = std::min<std::size_t>(without.size(), 5);
        throw std::runtime_error(fmt::format("{}: {} of {} nodes have no radius: {}{}", file, without.size(), nodes.size(),
                                             fmt::join(without.begin(), without.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                                             shown < without.size() ? ", ..." : ""));
    }
    return out;
}

ReadSpheres read_gid_text(const std::string& file, std::string text) {
    Lines in(file, std::move(text));
    Nodes nodes;
    std::set<int> others;
    std::string line;
    std::string block;
    bool spheres = false;
    while (in.next(line)) {
        const auto f = fields(line.substr(0, line.find('#')));
        if (f.empty()) {
            continue;
        }
        const std::string first = lower_case(f[0]);
        if (first == "mesh") {
            const std::string words = lower_case(line);
            spheres = words.find("sphere") != std::string::npos || words.find("circle") != std::string::npos;
        } else if (first == "coordinates" || first == "elements") {
            block = first;
        } else if (first == "end") {
            block.clear();
        } else if (block == "coordinates") {
            if (f.size() < 3) {
                in.fail("a node needs its number and coordinates");
            }
            nodes[in.whole(f[0])].centre = {in.real(f[1]), in.real(f[2]), f.size() > 3 ? in.real(f[3]) : 0.0};
        } else if (block == "elements" && !spheres) {
            for (std::size_t k = 1; k < f.size(); ++k) {
                others.insert(in.whole(f[k]));
            }
        } else if (block == "elements") {
            if (f.size() < 3) {
                in.fail("a sphere element needs number, node and radius");
            }
            declared(nodes, f[1], in).radius = in.radius(f[2]);
        }
    }
    if (!block.empty()) {
        in.fail("the file ends before \"end " + block + "\": it is cut short");
    }
    return in_order(file, nodes, others);
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
    const auto announced = [&](std::size_t at) { return static_cast<std::size_t>(std::max(value_at<std::int32_t>(bytes, at), 0)); };
    const std::size_t count = announced(12);
    const std::size_t elements = announced(16);
    const std::size_t first = gid_header + count * gid_node + 4;
    if (bytes.size() < first + elements * gid_element) {
        fail(fmt::format("{} nodes and {} spheres are announced, which take {} bytes, and the file has {}: it is cut short", count,
                         elements, first + elements * gid_element, bytes.size()));
    }
    Nodes nodes;
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t at = gid_header + k * gid_node;
        auto& sphere = nodes[value_at<std::int32_t>(bytes, at)];
        for (int c = 0; c < 3; ++c) {
            sphere.centre[c] = value_at<double>(bytes, at + 32 + 8 * static_cast<std::size_t>(c));
        }
        if (!sphere.centre.allFinite()) {
            fail(fmt::format("node {} has a coordinate that is not finite", value_at<std::int32_t>(bytes, at)));
        }
    }
    for (std::size_t k = 0; k < elements; ++k) {
        const std::size_t at = first + k * gid_element;
        const auto id = value_at<std::int32_t>(bytes, at + 32);
        const double radius = value_at<double>(bytes, at + 36);
        const auto node = nodes.find(id);
        if (node == nodes.end() || !(radius > 0.0) || !std::isfinite(radius)) {
            fail(fmt::format("sphere {}: {}", value_at<std::int32_t>(bytes, at),
                             node == nodes.end() ? fmt::format("node {} was not declared", id)
                                                 : fmt::format("radius {:.6g} is not positive", radius)));
        }
        node->second.radius = radius;
    }
    return in_order(file, nodes, {});
}

} // namespace

ReadSpheres read_mdpa(const std::string& file) {
    require_file(file);
    Lines in(file, input::read_text(file, largest_file));
    Nodes nodes;
    std::string line;
    std::vector<std::string> open; // blocks that have begun, each within the one before
    while (in.next(line)) {
        const auto f = fields(line.substr(0, line.find("//")));
        if (f.empty()) {
            continue;
        }
        const std::string block = open.empty() ? "" : open.back();
        if (f[0] == "Begin" && f.size() > 1) {
            open.push_back(f[1] + (f[1] == "NodalData" && f.size() > 2 ? " " + f[2] : ""));
        } else if (f[0] == "End") {
            if (open.empty() || f.size() < 2 || open.back().substr(0, open.back().find(' ')) != f[1]) {
                in.fail("\"" + line + "\" closes no block that is open");
            }
            open.pop_back();
        } else if (block == "Nodes") {
            if (f.size() < 4) {
                in.fail("a node needs its number and three coordinates");
            }
            nodes[in.whole(f[0])].centre = {in.real(f[1]), in.real(f[2]), in.real(f[3])};
        } else if (block == "NodalData RADIUS" || block == "NodalData COHESIVE_GROUP") {
            if (f.size() < 3) {
                in.fail("a node's number, whether it is fixed, and a value are expected");
            }
            ReadSphere& sphere = declared(nodes, f[0], in);
            if (block == "NodalData RADIUS") {
                sphere.radius = in.radius(f.back());
            } else {
                sphere.group = in.whole(f.back());
            }
        }
    }
    if (!open.empty()) {
        in.fail("the file ends before \"End " + open.back().substr(0, open.back().find(' ')) + "\": it is cut short");
    }
    return in_order(file, nodes, {});
}

ReadSpheres read_gid(const std::string& file) {
    require_file(file);
    std::string bytes = input::read_text(file, largest_file);
    return is_gid_binary(bytes) ? read_gid_binary(file, bytes) : read_gid_text(file, std::move(bytes));
}

} // namespace proveta
