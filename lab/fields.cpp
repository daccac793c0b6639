#include "lab/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/averaged_stress.hpp"
#include "lab/fragments.hpp"

namespace proveta {

namespace {

// Love-Weber stress of each sphere over its share of the volume, compression positive.
std::vector<double> stress_of(const Bench& bench) {
    const Model& m = *bench.model;
    std::vector<double> volume(m.spheres.size());
    for (std::size_t k = 0; k < volume.size(); ++k) {
        volume[k] = m.spheres.volume(k) / (1.0 - bench.statistics.porosity);
    }
    std::vector<double> stress;
    for (const Mat3& t : sphere_stresses(m.spheres, m.bonds, m.contacts, m.walls, m.pressures, volume)) {
        stress.insert(stress.end(), {t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(2, 0)});
    }
    return stress;
}

} // namespace

std::vector<double> damage_of(const Model& m, const std::vector<std::uint8_t>& mode) {
    std::vector<double> damage(m.spheres.size(), 0.0);
    const auto& in = m.bonds.incidence;
    for (std::size_t k = 0; k < damage.size(); ++k) {
        for (auto e = in.offset[k]; e < in.offset[k + 1]; ++e) {
            damage[k] += mode[in.entry[e] >> 1] != 0 ? 1.0 : 0.0;
        }
        damage[k] /= std::max(1.0, static_cast<double>(in.offset[k + 1] - in.offset[k]));
    }
    return damage;
}

report::Geometry sphere_fields(const Bench& bench) {
    const Model& m = *bench.model;
    report::Geometry g;
    g.points = m.spheres.position;
    VectorField moved(m.spheres.size());
    for (std::size_t k = 0; k < moved.size(); ++k) {
        moved.set(k, m.spheres.position.at(k) - m.spheres.start.at(k));
    }
    g.point_arrays = {{"radius", 1, m.spheres.radius},
                      {"displacement", 3, report::interleaved(moved)},
                      {"velocity", 3, report::interleaved(m.spheres.velocity)},
                      {"stress", 6, stress_of(bench)},
                      {"damage", 1, damage_of(m, m.bonds.mode)},
                      {"fragment", 1, report::as_numbers(fragments(m))},
                      {"group", 1, report::as_numbers(m.spheres.group)},
                      {"material", 1, report::as_numbers(m.spheres.material)}};
    return g;
}

report::Geometry bond_fields(const Bench& bench) {
    const Model& m = *bench.model;
    report::Geometry g;
    g.points = m.spheres.position;
    std::vector<double> damage;
    for (const auto& block : m.bonds.blocks) {
        for (std::size_t b = block.begin; b < block.end; ++b) {
            g.cells.push_back({m.bonds.i[b], m.bonds.j[b]});
            damage.push_back(m.bonds.damage(b, m.bonds.groups[block.group]));
        }
    }
    g.cell_arrays = {{"mode", 1, report::as_numbers(m.bonds.mode)},
                     {"damage", 1, damage},
                     {"failure_criterion", 1, m.bonds.criterion},
                     {"normal_force", 1, m.bonds.normal},
                     {"shear_force", 1, m.bonds.shear}};
    return g;
}

namespace {

// Outline of a face: flat and across z a disc, otherwise a strip of rectangles along z, as wide as the face or a little wider than the
// specimen.
std::vector<std::vector<Vec3>> outline(const Platen& p, const Shape& shape) {
    const double size = 0.6 * (shape.kind == ShapeKind::prism ? std::hypot(shape.width, shape.depth) : shape.lateral_size());
    constexpr int corners = 48;
    std::vector<std::vector<Vec3>> cells;
    if (p.face.axis.z() != 0.0) {
        cells.emplace_back();
        for (int k = 0; k < corners; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / corners;
            cells.back().emplace_back(size * std::cos(angle), size * std::sin(angle), p.position);
        }
        return cells;
    }
    const Vec3 across = Vec3::UnitZ().cross(p.face.axis);
    const double half = std::min(p.face.half_width, size);
    const bool ring =
        p.face.curvature > 0.0 && p.face.half_width == Face::boundless && p.position * p.face.inward * p.face.curvature < -0.999;
    const auto at = [&](int k) {
        const double along = 2.0 * k / corners - 1.0;
        if (p.face.curvature == 0.0) {
            return Vec3(p.position * p.face.axis + along * half * across);
        }
        const double radius = 1.0 / p.face.curvature;
        const double angle = ring ? std::numbers::pi * along : std::asin(std::min(1.0, half / radius)) * along;
        const Vec3 centre = (p.position + p.face.inward * radius) * p.face.axis;
        return Vec3(centre - p.face.inward * radius * std::cos(angle) * p.face.axis + radius * std::sin(angle) * across);
    };
    for (int k = 0; k < corners; ++k) {
        const Vec3 up(0.0, 0.0, shape.height);
        cells.push_back({at(k), at(k + 1), at(k + 1) + up, at(k) + up});
    }
    return cells;
}

} // namespace

report::Geometry body_fields(const Model& model) {
    report::Geometry g;
    std::vector<double> moved;
    std::vector<double> velocity;
    for (const auto& body : model.walls.bodies) {
        const auto first = static_cast<std::int64_t>(g.points.size());
        const Solid& solid = body.solid;
        for (std::size_t k = 0; k < solid.nodes(); ++k) {
            const Vec3 u = solid.position[k] - solid.mesh().node[k];
            g.points.push_back(solid.position[k]);
            moved.insert(moved.end(), u.begin(), u.end());
            velocity.insert(velocity.end(), solid.velocity[k].begin(), solid.velocity[k].end());
        }
        for (const auto& face : body.skin.faces()) {
            g.cells.emplace_back();
            for (std::size_t c = 0; c < (face.quadrilateral ? 4 : 3); ++c) {
                g.cells.back().push_back(first + face.node[c]);
            }
        }
    }
    g.point_arrays = {{"displacement", 3, moved}, {"velocity", 3, velocity}};
    return g;
}

report::Geometry platen_fields(const Bench& bench) {
    report::Geometry g;
    std::vector<double> thrust;
    for (const auto& p : bench.model->walls.platens) {
        for (const auto& cell : outline(p, bench.specimen.shape)) {
            g.cells.emplace_back();
            for (const Vec3& corner : cell) {
                g.cells.back().push_back(static_cast<std::int64_t>(g.points.size()));
                g.points.push_back(corner);
            }
            thrust.push_back(p.thrust);
        }
    }
    g.cell_arrays = {{"force", 1, thrust}};
    return g;
}

double quantile(std::vector<double> values, double share) {
    if (values.empty()) {
        return 0.0;
    }
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

namespace {

// The plane of a picture: along the axis of a specimen that is pressed there; across the axis, the load upright, of one that is split.
struct Plane {
    int right, up, out;  // components
    double middle = 0.0; // of the third, m
    double raise = 0.0;  // of the picture's base, m
};

Plane plane_of(const Bench& bench) {
    const Shape& shape = bench.specimen.shape;
    return bench.press.bands ? Plane{0, 2, 1} : Plane{1, 0, 2, 0.5 * shape.height, 0.5 * shape.diameter};
}

// A crack lies across its bond: a stroke perpendicular to it in the plane of the picture, as long as the bond's contact area is wide.
report::PictureLine stroke(const Model& m, const Plane& plane, std::size_t b) {
    const auto i = static_cast<std::size_t>(m.bonds.i[b]);
    const auto j = static_cast<std::size_t>(m.bonds.j[b]);
    const Vec3 a = m.spheres.position.at(i);
    const Vec3 to = m.spheres.position.at(j) - a;
    const Vec3 middle = a + 0.5 * to;
    const double across = to[plane.right];
    const double up = to[plane.up];
    const double flat = std::max(std::hypot(across, up), 1e-300);
    const double wide = m.spheres.planar ? 0.5 * m.bonds.area[b] : std::sqrt(m.bonds.area[b] / std::numbers::pi);
    const double reach = wide * flat / to.norm();
    const double dx = -reach * up / flat;
    const double dz = reach * across / flat;
    const double x = middle[plane.right];
    const double z = middle[plane.up] + plane.raise;
    const double parted = (to - (m.spheres.start.at(j) - m.spheres.start.at(i))).norm();
    return {x - dx, z - dz, x + dx, z + dz, m.bonds.mode[b], parted};
}

// Where a skin goes through the plane.
std::vector<report::PictureLine> cut(const Skin& skin, const Plane& plane) {
    std::vector<report::PictureLine> out;
    for (std::uint32_t t = 0; t < skin.triangles(); ++t) {
        const auto v = skin.geometry().corners(t);
        std::vector<Vec3> through;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& a = v[k];
            const Vec3& b = v[(k + 1) % 3];
            const double da = a[plane.out] - plane.middle;
            const double db = b[plane.out] - plane.middle;
            if ((da < 0.0) != (db < 0.0)) {
                through.emplace_back(a + (b - a) * (da / (da - db)));
            }
        }
        if (through.size() == 2) {
            out.push_back({through[0][plane.right], through[0][plane.up] + plane.raise, through[1][plane.right],
                           through[1][plane.up] + plane.raise, 0, 0.6});
        }
    }
    return out;
}

} // namespace

report::Picture membrane_view(const Bench& bench, const std::string& title) {
    const Solid& solid = bench.model->walls.bodies.front().solid;
    const auto& start = solid.mesh().node;
    const auto outwards = [&](std::uint32_t k) {
        return std::hypot(solid.position[k].x(), solid.position[k].y()) - std::hypot(start[k].x(), start[k].y());
    };
    struct Seen {
        double depth, moved;
        report::PictureFacet facet;
    };
    std::vector<Seen> seen;
    std::vector<double> moves;
    const Vec3 light = Vec3(-0.6, -0.7, 0.4).normalized();
    for (const auto& t : solid.mesh().membranes) {
        const Vec3 a = solid.position[t[0]];
        const Vec3 b = solid.position[t[1]];
        const Vec3 c = solid.position[t[2]];
        const Vec3 normal = (b - a).cross(c - a).normalized();
        if (normal.y() < 0.0) { // it is looked at along y
            const double moved = (outwards(t[0]) + outwards(t[1]) + outwards(t[2])) / 3.0;
            seen.push_back({(a.y() + b.y() + c.y()) / 3.0,
                            moved,
                            {{{a.x(), a.z()}, {b.x(), b.z()}, {c.x(), c.z()}}, 0.0, 0.5 * (1.0 + normal.dot(light))}});
            moves.push_back(moved);
        }
    }
    std::stable_sort(seen.begin(), seen.end(), [](const Seen& x, const Seen& y) { return x.depth > y.depth; });
    const double farthest = std::max(quantile(moves, 0.98), 0.0);
    report::Picture p;
    p.title = title;
    p.width = bench.specimen.shape.diameter + 2.0 * farthest;
    p.height = bench.specimen.shape.height;
    for (auto& s : seen) {
        s.facet.value = farthest > 0.0 ? s.moved / farthest : 0.0;
        p.facets.push_back(std::move(s.facet));
    }
    p.caption = fmt::format("The membrane from the side. Red: outwards, up to {:.3g} mm.", 1e3 * farthest);
    return p;
}

report::Picture slice(const Bench& bench, const std::string& title) {
    const Model& m = *bench.model;
    const Shape& shape = bench.specimen.shape;
    const Plane plane = plane_of(bench);
    report::Picture p;
    p.title = title;
    p.width = shape.kind == ShapeKind::cylinder ? shape.diameter : shape.width;
    p.height = bench.press.bands ? shape.height : shape.diameter;
    const double half = bench.statistics.mean_radius;
    std::vector<double> sideways;
    for (std::size_t k = 0; k < m.spheres.size(); ++k) {
        if (std::fabs(m.spheres.start.at(k)[plane.out] - plane.middle) < half) {
            const Vec3 at = m.spheres.position.at(k);
            const Vec3 moved = at - m.spheres.start.at(k);
            sideways.push_back(std::hypot(moved[plane.right], moved[plane.out]));
            p.dots.push_back({at[plane.right], at[plane.up] + plane.raise, m.spheres.radius[k], sideways.back()});
        }
    }
    std::vector<report::PictureLine> skin_lines;
    std::vector<double> parted;
    for (std::size_t b = 0; b < m.bonds.size(); ++b) {
        const auto out = [&](std::int32_t k) { return m.spheres.start.at(static_cast<std::size_t>(k))[plane.out]; };
        if (m.bonds.mode[b] != 0 && std::fabs(0.5 * (out(m.bonds.i[b]) + out(m.bonds.j[b])) - plane.middle) < half) {
            p.lines.push_back(stroke(m, plane, b));
            parted.push_back(p.lines.back().weight);
        }
    }
    for (const auto& body : m.walls.bodies) {
        const auto lines = cut(body.skin, plane);
        for (const auto& line : lines) {
            p.width = std::max({p.width, 2.0 * std::fabs(line.x0), 2.0 * std::fabs(line.x1)});
        }
        skin_lines.insert(skin_lines.end(), lines.begin(), lines.end());
    }
    const double farthest = quantile(sideways, 0.98);
    const double widest = quantile(parted, 0.98);
    for (auto& dot : p.dots) {
        dot.value /= std::max(farthest, 1e-300);
    }
    for (auto& line : p.lines) {
        line.weight /= std::max(widest, 1e-300);
    }
    p.caption = m.spheres.planar    ? "The plate."
                : bench.press.bands ? "Slice through the axis, two mean radii thick."
                                    : "Slice at mid-thickness, two mean radii thick, loaded from above and below.";
    if (farthest > 0.0) {
        p.caption += fmt::format(" Shade: sideways displacement, up to {:.3g} mm.", 1e3 * farthest);
    }
    if (!p.lines.empty()) {
        p.caption += fmt::format(
            " Strokes: {} failed bonds, red in tension, amber in shear, the bolder the wider they have opened (up to {:.2g} mm).",
            p.lines.size(), 1e3 * widest);
    }
    if (!skin_lines.empty()) {
        p.lines.insert(p.lines.end(), skin_lines.begin(), skin_lines.end());
        p.caption += " Dark line: the membrane.";
    }
    return p;
}

} // namespace proveta
