#include "specimens/import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "core/files/whole_file.hpp"
#include "core/input/words.hpp"
#include "specimens/sphere_file.hpp"

namespace proveta {

namespace {

constexpr double widest = 100.0;      // m, as of a recipe
constexpr double least_filled = 0.25; // of the shape, by the spheres of a packing
constexpr double empty = 0.01;        // of the shape: less is no packing at all

// Cyclic change of axes, so that handedness is kept.
Vec3 turned(const Vec3& p, char axis) {
    if (axis == 'x') {
        return {p.y(), p.z(), p.x()};
    }
    return axis == 'y' ? Vec3(p.z(), p.x(), p.y()) : p;
}

// Name in the file of the axis that is `k` of the turned ones.
char name_of(int k, char axis) { return static_cast<char>('x' + (k + (axis == 'x' ? 1 : axis == 'y' ? 2 : 0)) % 3); }

ReadSpheres read(const std::string& file, const std::string& columns) {
    const std::string ending = input::lower_case(std::filesystem::path(file).extension().string());
    if (ending == ".mdpa" || ending == ".msh") {
        if (!columns.empty()) {
            throw std::runtime_error(file + ": --columns is for tables; a mesh says itself what its numbers are");
        }
        return ending == ".mdpa" ? read_mdpa(file) : read_gid(file);
    }
    if (ending == ".csv" || ending == ".txt" || ending == ".xyzr" || ending == ".dat") {
        return read_sphere_table(file, columns);
    }
    throw std::runtime_error(file + ": unknown ending; expected .csv, .txt, .xyzr, .dat, .mdpa or .msh");
}

// Extent of the spheres, and which of them reaches farthest from the rest.
struct Extent {
    Vec3 low = Vec3::Constant(1e300);
    Vec3 high = Vec3::Constant(-1e300);
    std::size_t outermost = 0;
    double rest = 0.0; // the same extent's largest side without that sphere, m
};

Extent extent_of(const std::vector<ReadSphere>& spheres) {
    Extent out;
    std::array<std::vector<double>, 3> along;
    for (auto& coordinates : along) {
        coordinates.reserve(spheres.size());
    }
    for (const auto& s : spheres) {
        for (int c = 0; c < 3; ++c) {
            along[static_cast<std::size_t>(c)].push_back(s.centre[c]);
        }
    }
    Vec3 middle;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto half = along[c].begin() + static_cast<std::ptrdiff_t>(along[c].size() / 2);
        std::nth_element(along[c].begin(), half, along[c].end());
        middle[static_cast<Eigen::Index>(c)] = *half;
    }
    double farthest = -1.0;
    for (std::size_t k = 0; k < spheres.size(); ++k) {
        const double away = (spheres[k].centre - middle).cwiseAbs().maxCoeff() + spheres[k].radius;
        if (away > farthest) {
            farthest = away;
            out.outermost = k;
        }
    }
    Vec3 low = out.low;
    Vec3 high = out.high;
    for (std::size_t k = 0; k < spheres.size(); ++k) {
        const Vec3 r = Vec3::Constant(spheres[k].radius);
        out.low = out.low.cwiseMin(spheres[k].centre - r);
        out.high = out.high.cwiseMax(spheres[k].centre + r);
        if (k != out.outermost) {
            low = low.cwiseMin(spheres[k].centre - r);
            high = high.cwiseMax(spheres[k].centre + r);
        }
    }
    out.rest = (high - low).maxCoeff();
    return out;
}

// Where the surface lies that spheres of the skin rest on. ends: how far each sphere reaches against the outward normal, lowest outermost.
// Meshes that others relaxed have spheres that stand out of their faces, so that the farthest says little: most of the skin ends within a
// narrow band about the face itself, the first crowded one from outside. A skin without such a band is rough, and ends at its farthest
// sphere.
double surface_of(std::vector<double> ends, double grain) {
    std::sort(ends.begin(), ends.end());
    const double band = 0.25 * grain;
    const double depth = 4.0 * grain;
    const auto layer = std::upper_bound(ends.begin(), ends.end(), ends.front() + depth) - ends.begin();
    std::vector<std::ptrdiff_t> within; // spheres in the band that begins with each
    for (std::ptrdiff_t low = 0, high = 0; low != layer; ++low) {
        while (high != layer && ends[static_cast<std::size_t>(high)] <= ends[static_cast<std::size_t>(low)] + band) {
            ++high;
        }
        within.push_back(high - low);
    }
    const auto most = *std::max_element(within.begin(), within.end());
    const double evenly = static_cast<double>(layer) * band / depth;
    if (most < 10 || static_cast<double>(most) < 2.0 * evenly) {
        return ends.front();
    }
    const auto first = std::find_if(within.begin(), within.end(), [&](auto n) { return 2 * n >= most; }) - within.begin();
    const auto last =
        std::upper_bound(ends.begin() + first, ends.begin() + layer, ends[static_cast<std::size_t>(first)] + 2.0 * band) - ends.begin();
    const auto begin = std::max_element(within.begin() + first, within.begin() + last) - within.begin();
    const auto count = within[static_cast<std::size_t>(begin)];
    return std::accumulate(ends.begin() + begin, ends.begin() + begin + count, 0.0) / static_cast<double>(count);
}

// Two spheres in one place are one that was written twice.
void refuse_coincident(const std::string& file, const ReadSpheres& found) {
    const auto& spheres = found.spheres;
    std::vector<std::size_t> order(spheres.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](std::size_t k) {
        const Vec3& c = spheres[k].centre;
        return std::tuple(c.x(), c.y(), c.z());
    };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return std::tuple(key(a), a) < std::tuple(key(b), b); });
    std::vector<std::string> pairs;
    for (std::size_t k = 1; k < order.size(); ++k) {
        if (key(order[k]) == key(order[k - 1])) {
            pairs.push_back(found.where(order[k - 1]) + " and " + found.where(order[k]));
        }
    }
    if (!pairs.empty()) {
        throw std::runtime_error(fmt::format("{}: {} spheres lie where another does: {}", file, pairs.size(), input::first_few(pairs)));
    }
}

// What tells that the axis or the shape is not what was said. sides: across in x and y, and along z, m; reach: of the spheres from the
// axis.
std::string misfit(const Vec3& sides, double reach, double grain, char axis) {
    const auto alike = [&](double a, double b) { return std::fabs(a - b) <= std::max(4.0 * grain, 0.1 * std::max(a, b)); };
    if (!alike(sides.x(), sides.y())) {
        const char other = alike(sides.x(), sides.z()) ? name_of(1, axis) : alike(sides.y(), sides.z()) ? name_of(0, axis) : '\0';
        return fmt::format("a section of {:.4g} x {:.4g} mm is not round; {}", 1e3 * sides.x(), 1e3 * sides.y(),
                           other != '\0' ? fmt::format("is {} its axis (--axis {})?", other, other) : "--shape prism takes it as it is");
    }
    if (reach > 0.5 * std::max(sides.x(), sides.y()) * 1.2 + grain) {
        return "spheres fill the corners of its section, which is not round; --shape prism takes it as it is";
    }
    return "";
}

} // namespace

Imported import_specimen(const std::string& file, const ImportOptions& o) {
    Imported result;
    ReadSpheres found = read(file, o.columns);
    auto& spheres = found.spheres;
    const auto fail = [&](const std::string& what) { throw std::runtime_error(file + ": " + what); };
    if (spheres.size() < 2) {
        fail(fmt::format("{} spheres found; a specimen needs at least 2", spheres.size()));
    }
    if (found.in_metres && o.scale > 0.0 && o.scale != 1.0) {
        fail(fmt::format("--scale {:.6g}, while its headings say the unit", o.scale));
    }
    const double scale = o.scale > 0.0 ? o.scale : 1.0;
    double grain = 0.0;
    double matter = 0.0;
    for (auto& s : spheres) {
        s.centre = turned(s.centre, o.axis) * scale;
        s.radius *= scale;
        grain += s.radius / static_cast<double>(spheres.size());
        matter += 4.0 / 3.0 * std::numbers::pi * s.radius * s.radius * s.radius;
    }
    refuse_coincident(file, found);
    const Extent extent = extent_of(spheres);
    const Vec3 sides = extent.high - extent.low;
    if (sides.maxCoeff() > 2.0 * extent.rest && spheres.size() > 10) {
        fail(fmt::format("the sphere of {} lies far from all others: without it they are {:.4g} m long, with it {:.4g} m",
                         found.where(extent.outermost), extent.rest, sides.maxCoeff()));
    }
    if (sides.maxCoeff() > widest) {
        fail(fmt::format("spheres over {:.4g} m, {:.4g} m at most; a file in mm needs --scale 0.001", sides.maxCoeff(), widest));
    }

    Specimen& out = result.specimen;
    out.shape.kind = o.shape == "prism" ? ShapeKind::prism : ShapeKind::cylinder;
    const bool round = out.shape.kind == ShapeKind::cylinder;
    Vec3 low = extent.low;
    Vec3 high = extent.high;
    std::vector<double> ends(spheres.size());
    for (int c = round ? 2 : 0; c < 3; ++c) { // flat faces
        std::transform(spheres.begin(), spheres.end(), ends.begin(), [&](const auto& s) { return s.centre[c] - s.radius; });
        low[c] = surface_of(ends, grain);
        std::transform(spheres.begin(), spheres.end(), ends.begin(), [&](const auto& s) { return -s.centre[c] - s.radius; });
        high[c] = -surface_of(ends, grain);
    }
    const Vec3 fitted = high - low;
    const Vec3 middle = 0.5 * (low + high);
    out.shape.height = o.height > 0.0 ? o.height : fitted.z();
    out.shape.width = o.width > 0.0 ? o.width : fitted.x();
    out.shape.depth = o.depth > 0.0 ? o.depth : fitted.y();
    double across = 0.0;
    for (std::size_t k = 0; k < spheres.size(); ++k) {
        auto& s = spheres[k];
        s.centre -= Vec3(middle.x(), middle.y(), middle.z() - 0.5 * out.shape.height);
        ends[k] = -std::hypot(s.centre.x(), s.centre.y()) - s.radius;
        across = std::max(across, -ends[k]);
        out.spheres.centre.push_back(s.centre);
        out.spheres.radius.push_back(s.radius);
        out.group.push_back(s.group);
    }
    const double mantle = -2.0 * surface_of(ends, grain);
    out.shape.diameter = o.diameter > 0.0 ? o.diameter : mantle;
    if (round && spheres.size() > 50) {
        const std::string wrong = misfit(sides, across, grain, o.axis);
        if (!wrong.empty()) {
            fail(wrong);
        }
    }
    if (matter > out.shape.volume()) {
        fail(fmt::format("the spheres' volumes are {:.4g} of the {} that they should fill{}", matter / out.shape.volume(), out.shape.text(),
                         "; if the sizes are diameters or stand in another column: --columns x,y,z,d"));
    }
    if (matter < empty * out.shape.volume() && spheres.size() > 10) {
        fail(fmt::format("the spheres fill {:.2g} of the {}, where packings fill 0.5 to 0.8: their sizes are in another unit than their "
                         "places, or are diameters or radii of something else",
                         matter / out.shape.volume(), out.shape.text()));
    }

    result.notes = std::move(found.notes);
    result.warnings = std::move(found.warnings);
    if (matter < least_filled * out.shape.volume()) {
        result.warnings.push_back(
            fmt::format("the spheres fill {:.2g} of the {}, where packings fill 0.5 to 0.8: sizes in another unit than "
                        "places, or radii read as diameters?",
                        matter / out.shape.volume(), out.shape.text()));
    }
    if (out.shape.height > 5.0 && !found.in_metres && o.scale <= 0.0) {
        result.warnings.push_back(fmt::format("{:.4g} m high: if the file is in mm, give --scale 0.001", out.shape.height));
    }
    const auto compare = [&](const char* what, double said, double found_there) {
        if (said > 0.0 && std::fabs(said - found_there) > std::max(0.4 * grain, 0.002 * found_there)) {
            result.warnings.push_back(fmt::format("{} of {:.4g} mm where the spheres take {:.4g} mm: platens start {} the skin", what,
                                                  1e3 * said, 1e3 * found_there, said > found_there ? "away from" : "inside"));
        }
    };
    compare("height", o.height, fitted.z());
    if (round) {
        compare("diameter", o.diameter, mantle);
    } else {
        compare("width", o.width, fitted.x());
        compare("depth", o.depth, fitted.y());
    }
    out.recipe = {{"imported_from", std::filesystem::path(file).filename().string()}, {"axis", std::string(1, o.axis)}, {"scale", scale}};
    return result;
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
