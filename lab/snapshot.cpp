#include "lab/snapshot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lab/fields.hpp"

namespace proveta {

namespace {

using report::Ball;
using report::Body;
using report::Colour;
using report::Disc;
using report::View;

const Colour in_tension{0.85f, 0.37f, 0.01f};
const Colour in_shear{0.12f, 0.35f, 0.75f};

// All moments fit in: where the specimen starts and a little more, so that pieces that fly away do not make it small.
report::Frame frame_of(const Bench& bench) {
    const Spheres& s = bench.model->spheres;
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 high = -low;
    for (std::size_t k = 0; k < s.size(); ++k) {
        low = low.cwiseMin(s.start.at(k) - Vec3::Constant(s.radius[k]));
        high = high.cwiseMax(s.start.at(k) + Vec3::Constant(s.radius[k]));
    }
    const Vec3 more = 0.06 * (high - low);
    return {low - more, high + more};
}

template <class ColourOf> std::vector<Ball> balls(const Bench& bench, const Snapshot& at, const ColourOf& colour) {
    std::vector<Ball> out;
    for (std::size_t k = 0; k < at.position.size(); ++k) {
        out.push_back({at.position.at(k), bench.model->spheres.radius[k], colour(k)});
    }
    return out;
}

std::vector<Ball> balls_by_damage(const Bench& bench, const Snapshot& at) {
    const auto damage = damage_of(*bench.model, at.mode);
    return balls(bench, at, [&](std::size_t k) { return report::damage_colour(damage[k]); });
}

// A disc that is pressed along its diameter, x: it is looked at along its own axis, with the load upright.
bool on_its_side(const Bench& bench) { return !bench.press.bands; }

// The cut along the load, from in front of it.
View in_front(const Bench& bench, bool cut) {
    const bool through = cut && !bench.model->spheres.planar;
    return on_its_side(bench) ? View{-90.0, 90.0, through} : View{0.0, 0.0, through};
}

// Failed bonds as round plates of the bond's area, between where its spheres are now: those in a layer of two grains about the axis, or all
// of a plate.
std::vector<Disc> cracks(const Bench& bench, const Snapshot& at) {
    const Bonds& b = bench.model->bonds;
    const bool flat = bench.model->spheres.planar;
    std::vector<Disc> out;
    for (std::size_t k = 0; k < at.mode.size(); ++k) {
        if (at.mode[k] == 0) {
            continue;
        }
        const Vec3 from = at.position.at(static_cast<std::size_t>(b.i[k]));
        const Vec3 to = at.position.at(static_cast<std::size_t>(b.j[k]));
        const Vec3 along = to - from;
        const Vec3 middle = 0.5 * (from + to);
        const bool near =
            flat || (on_its_side(bench) ? std::fabs(middle.z() - 0.5 * bench.specimen.shape.height) : std::fabs(middle.y())) < bench.grain;
        if (along.norm() > 0.0 && near) {
            out.push_back({0.5 * (from + to), along.normalized(), std::sqrt(b.area[k] / std::numbers::pi),
                           at.mode[k] == static_cast<std::uint8_t>(FailureMode::tension) ? in_tension : in_shear});
        }
    }
    return out;
}

double moved(const Bench& bench, const Snapshot& at, std::size_t k) {
    return (at.position.at(k) - bench.model->spheres.start.at(k)).norm();
}

// The cut along the load, its spheres coloured by how far they have moved to the side, all movements drawn larger than they are
// (as thesis figs 5.31 and 5.33).
struct Sideways {
    std::vector<Ball> balls;
    double most;   // m
    double larger; // movements are drawn as
};

Sideways sideways(const Bench& bench, const Snapshot& at) {
    const Vec3 right = on_its_side(bench) ? Vec3(0, -1, 0) : Vec3(1, 0, 0); // of the picture
    const auto& start = bench.model->spheres.start;
    std::vector<double> way;
    std::vector<double> size;
    for (std::size_t k = 0; k < at.position.size(); ++k) {
        way.push_back((at.position.at(k) - start.at(k)).dot(right));
        size.push_back(std::fabs(way.back()));
    }
    Sideways out{{}, quantile(std::move(size), 0.98), 1.0};
    // By the largest of 1, 2, 5, 10 ... that moves nothing farther than a fiftieth of the specimen's height.
    const double room = 0.02 * bench.specimen.shape.height / std::max(out.most, 1e-300);
    const double ten = std::pow(10.0, std::floor(std::log10(std::clamp(room, 1.0, 1e6))));
    out.larger = room >= 5.0 * ten ? 5.0 * ten : room >= 2.0 * ten ? 2.0 * ten : ten;
    for (std::size_t k = 0; k < way.size(); ++k) {
        const Vec3 from = start.at(k);
        out.balls.push_back({from + out.larger * (at.position.at(k) - from), bench.model->spheres.radius[k],
                             report::diverging(out.most > 0.0 ? way[k] / out.most : 0.0)});
    }
    return out;
}

// Movement below which 98 % of the spheres are at all moments.
double common_displacement(const Bench& bench, const std::vector<Snapshot>& moments) {
    double most = 0.0;
    for (const auto& at : moments) {
        std::vector<double> all;
        for (std::size_t k = 0; k < at.position.size(); ++k) {
            all.push_back(moved(bench, at, k));
        }
        most = std::max(most, quantile(std::move(all), 0.98));
    }
    return most;
}

std::size_t failed(const Snapshot& at, FailureMode mode) {
    return static_cast<std::size_t>(std::count(at.mode.begin(), at.mode.end(), static_cast<std::uint8_t>(mode)));
}

} // namespace

Snapshot snapshot(const Model& m, const std::string& name, const std::string& title) {
    return {name, title, m.spheres.position, m.bonds.mode};
}

void visit_snapshot(const std::string& prefix, Snapshot& s, StateVisitor& visit) {
    visit(prefix + "name", s.name);
    visit(prefix + "title", s.title);
    visit(prefix + "position_x", s.position.x);
    visit(prefix + "position_y", s.position.y);
    visit(prefix + "position_z", s.position.z);
    visit(prefix + "mode", s.mode);
}

std::vector<NamedPortrait> portraits(const Bench& bench, const std::vector<Snapshot>& moments, int height) {
    const report::Frame frame = frame_of(bench);
    const double most = common_displacement(bench, moments);
    const bool bonded = bench.model->bonds.size() > 0;
    const bool flat = bench.model->spheres.planar;
    const View outside = flat ? View{0.0, 0.0, false} : View{30.0, 12.0, false};
    const View inside = in_front(bench, true);
    std::vector<NamedPortrait> out;
    const auto add = [&](const Snapshot& at, const std::string& what, const Body& body, const View& view, std::string caption,
                         std::string alt) {
        out.push_back(
            {at.name + "_" + what + ".png",
             {at.title, std::move(caption), at.title + ": " + std::move(alt), report::to_png(report::render(body, frame, view, height))}});
    };
    for (const auto& at : moments) {
        if (!bonded || &at != &moments.front()) { // nothing has moved at first
            const auto by_way =
                balls(bench, at, [&](std::size_t k) { return report::sequential(most > 0.0 ? moved(bench, at, k) / most : 0.0); });
            add(at, "displacement", {by_way, {}}, outside,
                fmt::format("Displacement from the start: dark blue 0, yellow {:.3g} mm and more.", 1e3 * most),
                "the specimen from outside, its spheres coloured by how far they have moved");
        }
        if (!bonded) {
            continue;
        }
        if (&at != &moments.front() && !flat) {
            const Sideways s = sideways(bench, at);
            add(at, "sideways", {s.balls, {}}, inside,
                fmt::format("Movement to the side in a cut along the load: blue to the left, red to the right, {:.2g} mm and more; all "
                            "movements drawn {:g} times as large.",
                            1e3 * s.most, s.larger),
                "a cut along the load, its spheres coloured by how far they have moved to either side");
        }
        const auto by_damage = balls_by_damage(bench, at);
        const std::size_t n = failed(at, FailureMode::tension) + failed(at, FailureMode::shear);
        add(at, "cut", {by_damage, {}}, inside, "Damage in a cut along the load: grey 0, dark red all bonds of a sphere failed.",
            fmt::format("a cut along the load, spheres coloured by damage; {} bonds have failed", n));
        if (n > 0) {
            add(at, "cracks", {{}, cracks(bench, at)}, in_front(bench, false),
                fmt::format(
                    "Failed bonds within a grain of that cut, as discs of their area: orange in tension, blue in shear; of all {} and {}.",
                    failed(at, FailureMode::tension), failed(at, FailureMode::shear)),
                fmt::format("the cracks about a cut along the load; in all {} bonds failed in tension and {} in shear",
                            failed(at, FailureMode::tension), failed(at, FailureMode::shear)));
        }
    }
    return out;
}

std::string still(const Bench& bench, const Snapshot& at, int height) {
    return report::to_png(report::render({balls_by_damage(bench, at), {}}, frame_of(bench), in_front(bench, true), height));
}

} // namespace proveta
