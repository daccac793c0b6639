#include "lab/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/averaged_stress.hpp"
#include "lab/fragments.hpp"

namespace proveta {

namespace {

// Love-Weber stress of each sphere over its share of the volume, compression positive, and the share of its bonds that failed.
void sphere_states(const Bench& bench, std::vector<double>& stress, std::vector<double>& damage) {
    const Model& m = *bench.model;
    const std::size_t n = m.spheres.size();
    std::vector<double> volume(n);
    damage.assign(n, 0.0);
    for (std::size_t k = 0; k < n; ++k) {
        volume[k] = m.spheres.volume(k) / (1.0 - bench.statistics.porosity);
        const auto& in = m.bonds.incidence;
        for (auto e = in.offset[k]; e < in.offset[k + 1]; ++e) {
            damage[k] += m.bonds.mode[in.entry[e] >> 1] != 0 ? 1.0 : 0.0;
        }
        damage[k] /= std::max(1.0, static_cast<double>(in.offset[k + 1] - in.offset[k]));
    }
    stress.clear();
    for (const Mat3& t : sphere_stresses(m.spheres, m.bonds, m.contacts, m.platens, m.pressures, volume)) {
        stress.insert(stress.end(), {t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(2, 0)});
    }
}

std::vector<double> interleaved(const VectorField& f) {
    std::vector<double> out;
    out.reserve(3 * f.size());
    for (std::size_t k = 0; k < f.size(); ++k) {
        out.insert(out.end(), {f.x[k], f.y[k], f.z[k]});
    }
    return out;
}

template <class T> std::vector<double> as_numbers(const std::vector<T>& values) { return {values.begin(), values.end()}; }

} // namespace

report::Geometry sphere_fields(const Bench& bench) {
    const Model& m = *bench.model;
    report::Geometry g;
    g.points = m.spheres.position;
    VectorField moved(m.spheres.size());
    for (std::size_t k = 0; k < moved.size(); ++k) {
        moved.set(k, m.spheres.position.at(k) - m.spheres.start.at(k));
    }
    std::vector<double> stress;
    std::vector<double> damage;
    sphere_states(bench, stress, damage);
    g.point_arrays = {{"radius", 1, m.spheres.radius},
                      {"displacement", 3, interleaved(moved)},
                      {"velocity", 3, interleaved(m.spheres.velocity)},
                      {"stress", 6, stress},
                      {"damage", 1, damage},
                      {"fragment", 1, as_numbers(fragments(m))},
                      {"group", 1, as_numbers(m.spheres.group)},
                      {"material", 1, as_numbers(m.spheres.material)}};
    return g;
}

report::Geometry bond_fields(const Bench& bench) {
    const Model& m = *bench.model;
    report::Geometry g;
    g.points = m.spheres.position;
    std::vector<double> damage;
    for (std::size_t b = 0; b < m.bonds.size(); ++b) {
        g.cells.push_back({m.bonds.i[b], m.bonds.j[b]});
        damage.push_back(std::max(m.bonds.damage_n[b], m.bonds.damage_t[b]));
    }
    g.cell_arrays = {{"mode", 1, as_numbers(m.bonds.mode)},
                     {"damage", 1, damage},
                     {"failure_criterion", 1, m.bonds.criterion},
                     {"normal_force", 1, m.bonds.normal},
                     {"shear_force", 1, m.bonds.shear}};
    return g;
}

report::Geometry platen_fields(const Bench& bench) {
    const Shape& shape = bench.specimen.shape;
    report::Geometry g;
    constexpr int corners = 48;
    std::vector<double> force;
    for (const auto& p : bench.model->platens) {
        std::vector<std::int64_t> cell;
        for (int k = 0; k < corners; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / corners;
            const double reach = 0.6 * (shape.kind == ShapeKind::prism ? std::hypot(shape.width, shape.depth) : shape.lateral_size());
            cell.push_back(static_cast<std::int64_t>(g.points.size()));
            g.points.push_back({reach * std::cos(angle), reach * std::sin(angle), p.position});
        }
        g.cells.push_back(cell);
        force.push_back(p.reaction.norm());
    }
    g.cell_arrays = {{"force", 1, force}};
    return g;
}

namespace {

// Value below which the given share of the values lies.
double quantile(std::vector<double> values, double share) {
    if (values.empty()) {
        return 0.0;
    }
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

// A crack lies across its bond: a stroke perpendicular to it in the plane of the picture, as long as the bond's contact area is wide.
report::PictureLine stroke(const Model& m, std::size_t b) {
    const auto i = static_cast<std::size_t>(m.bonds.i[b]);
    const auto j = static_cast<std::size_t>(m.bonds.j[b]);
    const Vec3 a = m.spheres.position.at(i);
    const Vec3 to = m.spheres.position.at(j) - a;
    const Vec3 middle = a + 0.5 * to;
    const double flat = std::max(std::hypot(to.x(), to.z()), 1e-300);
    const double wide = m.spheres.planar ? 0.5 * m.bonds.area[b] : std::sqrt(m.bonds.area[b] / std::numbers::pi);
    const double reach = wide * flat / to.norm();
    const Vec3 half(-reach * to.z() / flat, 0.0, reach * to.x() / flat);
    const double parted = (to - (m.spheres.start.at(j) - m.spheres.start.at(i))).norm();
    return {middle.x() - half.x(), middle.z() - half.z(), middle.x() + half.x(), middle.z() + half.z(), m.bonds.mode[b], parted};
}

} // namespace

report::Picture slice(const Bench& bench, const std::string& title) {
    const Model& m = *bench.model;
    const Shape& shape = bench.specimen.shape;
    report::Picture p;
    p.title = title;
    p.width = shape.kind == ShapeKind::cylinder ? shape.diameter : shape.width;
    p.height = shape.height;
    const double half = bench.statistics.mean_radius;
    std::vector<double> sideways;
    for (std::size_t k = 0; k < m.spheres.size(); ++k) {
        if (std::fabs(m.spheres.start.y[k]) < half) {
            const Vec3 at = m.spheres.position.at(k);
            const Vec3 moved = at - m.spheres.start.at(k);
            sideways.push_back(std::hypot(moved.x(), moved.y()));
            p.dots.push_back({at.x(), at.z(), m.spheres.radius[k], sideways.back()});
        }
    }
    std::vector<double> parted;
    for (std::size_t b = 0; b < m.bonds.size(); ++b) {
        const auto y = [&](std::int32_t k) { return m.spheres.start.y[static_cast<std::size_t>(k)]; };
        if (m.bonds.mode[b] != 0 && std::fabs(0.5 * (y(m.bonds.i[b]) + y(m.bonds.j[b]))) < half) {
            p.lines.push_back(stroke(m, b));
            parted.push_back(p.lines.back().weight);
        }
    }
    const double farthest = quantile(sideways, 0.98);
    const double widest = quantile(parted, 0.98);
    for (auto& dot : p.dots) {
        dot.value /= std::max(farthest, 1e-300);
    }
    for (auto& line : p.lines) {
        line.weight /= std::max(widest, 1e-300);
    }
    p.caption = m.spheres.planar ? "The plate." : "Slice through the axis, two mean radii thick.";
    if (farthest > 0.0) {
        p.caption += fmt::format(" Shade: sideways displacement, up to {:.3g} mm.", 1e3 * farthest);
    }
    if (!p.lines.empty()) {
        p.caption += fmt::format(
            " Strokes: {} failed bonds, red in tension, amber in shear, the bolder the wider they have opened (up to {:.2g} mm).",
            p.lines.size(), 1e3 * widest);
    }
    return p;
}

} // namespace proveta
