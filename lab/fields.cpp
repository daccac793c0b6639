#include "lab/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace proveta {

std::vector<int> fragments(const Model& model) {
    const std::size_t n = model.spheres.size();
    std::vector<std::size_t> parent(n);
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t k) {
        while (parent[k] != k) {
            parent[k] = parent[parent[k]];
            k = parent[k];
        }
        return k;
    };
    for (std::size_t b = 0; b < model.bonds.size(); ++b) {
        if (model.bonds.mode[b] == 0) {
            parent[root(static_cast<std::size_t>(model.bonds.i[b]))] = root(static_cast<std::size_t>(model.bonds.j[b]));
        }
    }
    std::vector<std::size_t> size(n, 0);
    for (std::size_t k = 0; k < n; ++k) {
        ++size[root(k)];
    }
    std::vector<std::size_t> roots;
    for (std::size_t k = 0; k < n; ++k) {
        if (size[k] > 0) {
            roots.push_back(k);
        }
    }
    std::stable_sort(roots.begin(), roots.end(), [&](auto a, auto b) { return size[a] > size[b]; });
    std::vector<int> number(n, 0);
    for (std::size_t k = 0; k < roots.size(); ++k) {
        number[roots[k]] = static_cast<int>(k);
    }
    std::vector<int> out(n);
    for (std::size_t k = 0; k < n; ++k) {
        out[k] = number[root(k)];
    }
    return out;
}

namespace {

// Love-Weber stress of each sphere over its share of the volume, compression positive, and the share of its bonds that failed.
void sphere_states(const Bench& bench, std::vector<double>& stress, std::vector<double>& damage) {
    const Model& m = *bench.model;
    const std::size_t n = m.spheres.size();
    std::vector<Mat3> sum(n, Mat3::Zero());
    damage.assign(n, 0.0);
    std::vector<double> bonds(n, 0.0);
    for (std::size_t b = 0; b < m.bonds.size(); ++b) {
        const auto i = static_cast<std::size_t>(m.bonds.i[b]);
        const auto j = static_cast<std::size_t>(m.bonds.j[b]);
        const Vec3 to = m.spheres.position.at(j) - m.spheres.position.at(i);
        const Mat3 part = -Vec3(m.bonds.forces[b].force) * to.transpose();
        sum[i] += m.bonds.forces[b].share_i * part;
        sum[j] += (1.0 - m.bonds.forces[b].share_i) * part;
        for (const auto k : {i, j}) {
            damage[k] += m.bonds.mode[b] != 0 ? 1.0 : 0.0;
            bonds[k] += 1.0;
        }
    }
    const double solid = 1.0 - bench.statistics.porosity;
    stress.clear();
    for (std::size_t k = 0; k < n; ++k) {
        const double r = m.spheres.radius[k];
        const Mat3 s = sum[k] * (solid / (4.0 / 3.0 * std::numbers::pi * r * r * r));
        const Mat3 t = 0.5 * (s + s.transpose());
        stress.insert(stress.end(), {t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(2, 0)});
        damage[k] /= std::max(1.0, bonds[k]);
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
            const double reach = 0.6 * (shape.kind == ShapeKind::cylinder ? shape.diameter : std::hypot(shape.width, shape.depth));
            cell.push_back(static_cast<std::int64_t>(g.points.size()));
            g.points.push_back({reach * std::cos(angle), reach * std::sin(angle), p.position});
        }
        g.cells.push_back(cell);
        force.push_back(p.reaction.norm());
    }
    g.cell_arrays = {{"force", 1, force}};
    return g;
}

report::Picture slice(const Bench& bench, const std::string& title) {
    const Model& m = *bench.model;
    const Shape& shape = bench.specimen.shape;
    report::Picture p;
    p.title = title;
    p.width = shape.kind == ShapeKind::cylinder ? shape.diameter : shape.width;
    p.height = shape.height;
    const double half = bench.statistics.mean_radius;
    double widest = 0.0;
    std::vector<std::size_t> shown;
    std::vector<double> sideways;
    for (std::size_t k = 0; k < m.spheres.size(); ++k) {
        if (std::fabs(m.spheres.start.y[k]) < half) {
            shown.push_back(k);
            const Vec3 moved = m.spheres.position.at(k) - m.spheres.start.at(k);
            sideways.push_back(std::hypot(moved.x(), moved.y()));
        }
    }
    if (!sideways.empty()) {
        auto sorted = sideways;
        std::sort(sorted.begin(), sorted.end());
        widest = sorted[static_cast<std::size_t>(0.98 * static_cast<double>(sorted.size() - 1))];
    }
    for (std::size_t k = 0; k < shown.size(); ++k) {
        const Vec3 at = m.spheres.position.at(shown[k]);
        p.dots.push_back({at.x(), at.z(), m.spheres.radius[shown[k]], widest > 0.0 ? sideways[k] / widest : 0.0});
    }
    std::size_t cracks = 0;
    for (std::size_t b = 0; b < m.bonds.size(); ++b) {
        const auto i = static_cast<std::size_t>(m.bonds.i[b]);
        const auto j = static_cast<std::size_t>(m.bonds.j[b]);
        const bool near = std::fabs(0.5 * (m.spheres.start.y[i] + m.spheres.start.y[j])) < half;
        if (m.bonds.mode[b] == 0 || !near) {
            continue;
        }
        // A crack lies across its bond: a stroke perpendicular to it, as wide as the bond's contact area.
        const Vec3 a = m.spheres.position.at(i);
        const Vec3 c = m.spheres.position.at(j);
        const double dx = c.x() - a.x();
        const double dz = c.z() - a.z();
        const double length = std::hypot(dx, dz);
        if (length <= 0.0) {
            continue;
        }
        const double reach = std::sqrt(m.bonds.area[b] / std::numbers::pi) * length / (c - a).norm();
        const double mx = 0.5 * (a.x() + c.x());
        const double mz = 0.5 * (a.z() + c.z());
        p.lines.push_back(
            {mx - reach * dz / length, mz + reach * dx / length, mx + reach * dz / length, mz - reach * dx / length, m.bonds.mode[b]});
        ++cracks;
    }
    p.caption = fmt::format(
        "Slice through the axis, two mean radii thick. Shade: sideways displacement, up to {:.3g} mm. Strokes: {} failed bonds, "
        "red in tension, amber in shear.",
        1e3 * widest, cracks);
    return p;
}

} // namespace proveta
