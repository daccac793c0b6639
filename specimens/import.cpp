#include "specimens/import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

#include "core/files/whole_file.hpp"
#include "core/input/text_file.hpp"
#include "specimens/memory.hpp"

namespace proveta {

namespace {

struct Sphere {
    Vec3 centre = Vec3::Zero();
    double radius = 0.0;
    int group = 0;
};

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

bool number(const std::string& text, double& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

// A text file read line by line, which knows where it is.
class Lines {
  public:
    explicit Lines(const std::string& file) : file_(file) {
        require_file(file);
        in_ = std::istringstream(input::read_text(file, largest_file));
    }
    bool next(std::string& line) {
        ++number_;
        return static_cast<bool>(std::getline(in_, line));
    }
    [[noreturn]] void fail(const std::string& what) const { throw std::runtime_error(fmt::format("{}:{}: {}", file_, number_, what)); }
    double real(const std::string& text) const {
        double x = 0.0;
        if (!number(text, x)) {
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

  private:
    std::string file_;
    std::istringstream in_;
    int number_ = 0;
};

std::vector<Sphere> read_table(Lines& in) {
    std::vector<Sphere> out;
    std::string line;
    while (in.next(line)) {
        const auto f = fields(line.substr(0, line.find('#')));
        double probe = 0.0;
        if (f.empty() || (out.empty() && !number(f[0], probe))) {
            continue; // blank, comment or heading
        }
        if (f.size() < 4) {
            in.fail(fmt::format("{} numbers where x y z r are expected", f.size()));
        }
        Sphere s{{in.real(f[0]), in.real(f[1]), in.real(f[2])}, in.real(f[3]), 0};
        if (f.size() > 4) {
            s.group = in.whole(f[4]);
        }
        if (s.radius <= 0.0) {
            in.fail(fmt::format("radius {} is not positive", f[3]));
        }
        out.push_back(s);
    }
    return out;
}

std::vector<Sphere> in_order(const std::map<int, Sphere>& by_id, Lines& in) {
    std::vector<Sphere> out;
    for (const auto& [id, s] : by_id) {
        if (s.radius > 0.0) {
            out.push_back(s);
        }
    }
    if (out.empty() && !by_id.empty()) {
        in.fail("nodes, but no radius for any of them");
    }
    return out;
}

std::vector<Sphere> read_mdpa(Lines& in) {
    std::map<int, Sphere> by_id;
    std::string line;
    std::string block;
    while (in.next(line)) {
        const auto f = fields(line.substr(0, line.find("//")));
        if (f.empty()) {
            continue;
        }
        if (f[0] == "Begin" && f.size() > 1) {
            block = f[1] + (f[1] == "NodalData" && f.size() > 2 ? " " + f[2] : "");
        } else if (f[0] == "End") {
            block.clear();
        } else if (block == "Nodes" && f.size() >= 4) {
            by_id[in.whole(f[0])].centre = {in.real(f[1]), in.real(f[2]), in.real(f[3])};
        } else if ((block == "NodalData RADIUS" || block == "NodalData COHESIVE_GROUP") && f.size() >= 3) {
            const auto node = by_id.find(in.whole(f[0]));
            if (node == by_id.end()) {
                in.fail("node " + f[0] + " was not declared");
            }
            if (block == "NodalData RADIUS") {
                const double value = in.real(f.back());
                if (value <= 0.0) {
                    in.fail("radius " + f.back() + " is not positive");
                }
                node->second.radius = value;
            } else {
                node->second.group = in.whole(f.back());
            }
        }
    }
    return in_order(by_id, in);
}

std::vector<Sphere> read_gid(Lines& in) {
    std::map<int, Sphere> by_id;
    std::string line;
    std::string block;
    bool spheres = false;
    while (in.next(line)) {
        const auto f = fields(line.substr(0, line.find('#')));
        if (f.empty()) {
            continue;
        }
        std::string first = f[0];
        std::transform(first.begin(), first.end(), first.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        if (first == "mesh") {
            std::string lower = line;
            std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
            spheres = lower.find("sphere") != std::string::npos || lower.find("circle") != std::string::npos;
        } else if (first == "coordinates" || first == "elements") {
            block = first;
        } else if (first == "end") {
            block.clear();
        } else if (block == "coordinates" && f.size() >= 3) {
            by_id[in.whole(f[0])].centre = {in.real(f[1]), in.real(f[2]), f.size() > 3 ? in.real(f[3]) : 0.0};
        } else if (block == "elements" && spheres) {
            if (f.size() < 3) {
                in.fail("a sphere element needs number, node and radius");
            }
            const auto node = by_id.find(in.whole(f[1]));
            const double radius = in.real(f[2]);
            if (node == by_id.end() || radius <= 0.0) {
                in.fail("sphere " + f[0] + " has an unknown node or no positive radius");
            }
            node->second.radius = radius;
        }
    }
    return in_order(by_id, in);
}

// Cyclic change of axes, so that handedness is kept.
Vec3 turned(const Vec3& p, char axis) {
    if (axis == 'x') {
        return {p.y(), p.z(), p.x()};
    }
    return axis == 'y' ? Vec3(p.z(), p.x(), p.y()) : p;
}

} // namespace

Specimen import_specimen(const std::string& file, const ImportOptions& o) {
    Lines in(file);
    std::string ending = std::filesystem::path(file).extension().string();
    std::vector<Sphere> spheres;
    if (ending == ".mdpa") {
        spheres = read_mdpa(in);
    } else if (ending == ".msh") {
        spheres = read_gid(in);
    } else if (ending == ".csv" || ending == ".txt" || ending == ".xyzr" || ending == ".dat") {
        spheres = read_table(in);
    } else {
        throw std::runtime_error(file + ": unknown ending; expected .csv, .txt, .xyzr, .dat, .mdpa or .msh");
    }
    if (spheres.size() < 2) {
        throw std::runtime_error(fmt::format("{}: {} spheres found; a specimen needs at least 2", file, spheres.size()));
    }
    Vec3 low = Vec3::Constant(1e300);
    Vec3 high = Vec3::Constant(-1e300);
    for (auto& s : spheres) {
        s.centre = turned(s.centre, o.axis) * o.scale;
        s.radius *= o.scale;
        low = low.cwiseMin(s.centre - Vec3::Constant(s.radius));
        high = high.cwiseMax(s.centre + Vec3::Constant(s.radius));
    }
    Specimen out;
    out.shape.kind = o.shape == "prism" ? ShapeKind::prism : ShapeKind::cylinder;
    out.shape.height = o.height > 0.0 ? o.height : high.z() - low.z();
    out.shape.width = o.width > 0.0 ? o.width : high.x() - low.x();
    out.shape.depth = o.depth > 0.0 ? o.depth : high.y() - low.y();
    const Vec3 middle = 0.5 * (low + high);
    double across = 0.0;
    for (auto& s : spheres) {
        s.centre -= Vec3(middle.x(), middle.y(), middle.z() - 0.5 * out.shape.height);
        across = std::max(across, std::hypot(s.centre.x(), s.centre.y()) + s.radius);
        out.spheres.centre.push_back(s.centre);
        out.spheres.radius.push_back(s.radius);
        out.group.push_back(s.group);
    }
    out.shape.diameter = o.diameter > 0.0 ? o.diameter : 2.0 * across;
    out.recipe = {{"imported_from", std::filesystem::path(file).filename().string()}, {"axis", std::string(1, o.axis)}, {"scale", o.scale}};
    return out;
}

void export_csv(const Specimen& s, const std::string& file) {
    std::string out = "x_m,y_m,z_m,r_m,group\n";
    const SpheresInSpace all = spheres_in_space(s);
    for (std::size_t k = 0; k < all.spheres.radius.size(); ++k) {
        const Vec3 p = all.spheres.centre.at(k);
        out += fmt::format("{:.17g},{:.17g},{:.17g},{:.17g},{}\n", p.x(), p.y(), p.z(), all.spheres.radius[k],
                           s.stones.empty() ? s.group[k] : all.particle[k]);
    }
    write_whole(file, out.data(), out.size());
}

} // namespace proveta
