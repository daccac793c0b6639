#include "lab/scene/scene_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/scene/vectors.hpp"

namespace proveta {

namespace {

// Particle that a sphere belongs to: itself, or its cluster behind all single spheres.
std::size_t particle_of(const Model& m, std::size_t sphere) {
    const auto body = m.clusters.of(sphere);
    return body < 0 ? sphere : m.clusters.alone(m.spheres) + static_cast<std::size_t>(body);
}

std::size_t particles_of(const Model& m) { return m.clusters.alone(m.spheres) + m.clusters.size(); }

Vec3 centre_of(const Model& m, std::size_t particle) {
    const std::size_t alone = m.clusters.alone(m.spheres);
    return particle < alone ? m.spheres.position.at(particle) : m.clusters.position[particle - alone];
}

double mass_of(const Model& m, std::size_t particle) {
    const std::size_t alone = m.clusters.alone(m.spheres);
    return particle < alone ? m.spheres.mass[particle] : m.clusters.mass[particle - alone];
}

Vec3 velocity_of(const Model& m, std::size_t particle) {
    const std::size_t alone = m.clusters.alone(m.spheres);
    return particle < alone ? m.spheres.velocity.at(particle) : m.clusters.velocity[particle - alone];
}

// How many contacts each particle has.
std::vector<int> touches_of(const Model& m) {
    std::vector<int> out(particles_of(m), 0);
    for (std::size_t k = 0; k < m.contacts.size(); ++k) {
        if (m.contacts.active[k] != 0 && m.contacts.normal[k] > 0.0) {
            ++out[particle_of(m, static_cast<std::size_t>(m.contacts.i[k]))];
            ++out[particle_of(m, static_cast<std::size_t>(m.contacts.j[k]))];
        }
    }
    for (const auto& surface : m.walls.surfaces) {
        for (const auto& block : surface.touches) {
            for (const auto& touch : block) {
                out[particle_of(m, static_cast<std::size_t>(touch.sphere))] += touch.force.isZero() ? 0 : 1;
            }
        }
    }
    for (const auto& body : m.walls.bodies) {
        for (const auto& block : body.touches) {
            for (const auto& touch : block) {
                out[particle_of(m, static_cast<std::size_t>(touch.sphere))] += touch.force.isZero() ? 0 : 1;
            }
        }
    }
    return out;
}

constexpr const char* axes = "xyz";

// What is told of a body at a sample.
struct BodyState {
    Vec3 centre = Vec3::Zero(); // of mass, m
    double farthest = 0.0;      // way of a node from its start, m
    double plastic = 0.0;       // largest plastic strain
    double volume = 0.0;        // inside the skin, m3
};

BodyState state_of(const Deformable& body) {
    BodyState s;
    double mass = 0.0;
    const Solid& solid = body.solid;
    for (std::size_t k = 0; k < solid.nodes(); ++k) {
        s.centre += solid.mass()[k] * solid.position[k];
        mass += solid.mass()[k];
        s.farthest = std::max(s.farthest, (solid.position[k] - solid.mesh().node[k]).norm());
    }
    s.centre /= mass;
    for (const double strain : solid.plastic_strain()) {
        s.plastic = std::max(s.plastic, strain);
    }
    s.volume = body.skin.geometry().mesh.volume();
    return s;
}

} // namespace

SceneState state_of(const Model& m) {
    SceneState s;
    s.particles = particles_of(m);
    double square = 0.0;
    for (std::size_t k = 0; k < s.particles; ++k) {
        const double speed = velocity_of(m, k).norm();
        square += speed * speed;
        s.fastest = std::max(s.fastest, speed);
        s.mass += mass_of(m, k);
    }
    const double n = std::max(1.0, static_cast<double>(s.particles));
    s.rms_speed = std::sqrt(square / n);
    for (const int touches : touches_of(m)) {
        s.touching += touches / n;
    }
    for (std::size_t k = 0; k < m.contacts.size(); ++k) {
        if (m.contacts.active[k] != 0) {
            const auto i = static_cast<std::size_t>(m.contacts.i[k]);
            const auto j = static_cast<std::size_t>(m.contacts.j[k]);
            const double overlap = m.spheres.radius[i] + m.spheres.radius[j] - (m.spheres.position.at(j) - m.spheres.position.at(i)).norm();
            s.overlap = std::max(s.overlap, overlap / std::min(m.spheres.radius[i], m.spheres.radius[j]));
        }
    }
    for (const auto& surface : m.walls.surfaces) {
        for (const auto& block : surface.touches) {
            for (const auto& touch : block) {
                s.overlap =
                    std::max(s.overlap, surface.overlap_of(touch, m.spheres) / m.spheres.radius[static_cast<std::size_t>(touch.sphere)]);
            }
        }
    }
    return s;
}

report::Table empty_scene_curve(const Model& m) {
    report::Table t;
    t.notes = {"Forces and torques are those of the particles on each surface; torques are about its position."};
    t.columns = {{"time", "s", "since the start"},
                 {"particles", "", "in the scene"},
                 {"mass", "kg", "of these"},
                 {"taken_out", "", "by outlets so far"},
                 {"lost", "", "out of the domain so far"},
                 {"rms_speed", "m/s", "root mean square of the particles' speeds"},
                 {"fastest", "m/s", "fastest particle"},
                 {"touching", "", "mean number of contacts a particle"},
                 {"largest_overlap", "", "of two spheres, or of a sphere and a surface, over the smaller radius"}};
    for (const auto& s : m.walls.surfaces) {
        for (const auto& [what, unit, meaning] :
             {std::tuple{"force", "N", "force on it"}, std::tuple{"torque", "Nm", "torque on it"}, std::tuple{"at", "m", "where it is"}}) {
            for (int c = 0; c < 3; ++c) {
                t.columns.push_back({fmt::format("{}_{}_{}", s.name, what, axes[c]), unit, fmt::format("surface {}: {}", s.name, meaning)});
            }
        }
    }
    for (const auto& b : m.walls.bodies) {
        const std::string& name = b.solid.name;
        for (int c = 0; c < 3; ++c) {
            t.columns.push_back(
                {fmt::format("{}_force_{}", name, axes[c]), "N", fmt::format("body {}: force of the particles on it", name)});
        }
        for (int c = 0; c < 3; ++c) {
            t.columns.push_back({fmt::format("{}_at_{}", name, axes[c]), "m", fmt::format("body {}: its centre of mass", name)});
        }
        t.columns.push_back({name + "_farthest", "m", fmt::format("body {}: farthest way of a node from its start", name)});
        t.columns.push_back({name + "_plastic_strain", "", fmt::format("body {}: largest accumulated plastic strain", name)});
        t.columns.push_back({name + "_volume", "m3", fmt::format("body {}: inside its skin, if that is closed", name)});
        for (const auto& hold : b.solid.holds) {
            for (int c = 0; c < 3; ++c) {
                t.columns.push_back(
                    {fmt::format("{}_{}_{}", name, hold.name, axes[c]), "N", fmt::format("body {}: force on what holds it there", name)});
            }
        }
    }
    return t;
}

report::Table empty_scene_energy() {
    report::Table t;
    t.notes = {"Energy ledger: every term is accumulated from its own mechanism, none by difference."};
    t.columns = {{"time", "s", "since the start"},
                 {"surfaces", "J", "work of moving surfaces on the particles, and of what holds bodies"},
                 {"pressure", "J", "work of pressures on bodies"},
                 {"gravity", "J", "work of gravity"},
                 {"initial", "J", "brought in by particles less taken out by those that left"},
                 {"coupling", "J", "made, or taken out where negative, by sharing contact forces out over bodies"},
                 {"elastic", "J", "stored in contacts and bodies"},
                 {"kinetic", "J", "of translation and rotation"},
                 {"plastic", "J", "dissipated by plastic strain of bodies"},
                 {"friction", "J", "dissipated by sliding and rolling"},
                 {"dashpots", "J", "dissipated by impact and by the damping of bodies"},
                 {"background", "J", "dissipated by background damping"},
                 {"residual", "J", "what was given minus all other terms"}};
    return t;
}

void sample_scene(const Model& m, const Feed& feed, report::Table& curve, report::Table& energy) {
    const SceneState s = state_of(m);
    double taken = 0.0;
    for (const auto n : feed.taken()) {
        taken += static_cast<double>(n);
    }
    std::vector<double> row{
        m.time(), static_cast<double>(s.particles), s.mass, taken, static_cast<double>(feed.lost()), s.rms_speed, s.fastest, s.touching,
        s.overlap};
    for (const auto& surface : m.walls.surfaces) {
        for (const Vec3& v : {surface.sums.reaction, surface.sums.torque, surface.origin}) {
            row.insert(row.end(), v.begin(), v.end());
        }
    }
    for (const auto& body : m.walls.bodies) {
        const BodyState b = state_of(body);
        row.insert(row.end(), body.sums.reaction.begin(), body.sums.reaction.end());
        row.insert(row.end(), b.centre.begin(), b.centre.end());
        row.insert(row.end(), {b.farthest, b.plastic, b.volume});
        for (const auto& hold : body.solid.holds) {
            row.insert(row.end(), hold.reaction.begin(), hold.reaction.end());
        }
    }
    curve.rows.push_back(std::move(row));
    const Ledger& l = m.ledger();
    energy.rows.push_back({m.time(), l.platens, l.pressure, l.body, l.initial, l.coupling, l.elastic, l.kinetic, l.plastic, l.friction,
                           l.dashpots, l.background, l.residual()});
}

BoxContent content_of(const OutletInput& box, const Model& m) {
    BoxContent out;
    out.name = box.name;
    const Eigen::AlignedBox3d region = box_of(box);
    const auto touches = touches_of(m);
    for (std::size_t k = 0; k < touches.size(); ++k) {
        if (region.contains(centre_of(m, k))) {
            ++out.particles;
            out.touching += touches[k];
            out.bulk_density += mass_of(m, k) / region.volume();
        }
    }
    out.touching /= std::max(1.0, static_cast<double>(out.particles));
    // Columns along z, exact in each: the spheres' pieces of it, joined where they overlap.
    constexpr int columns = 200;
    const Vec3 size = region.sizes();
    const double cell = std::max(size.x(), size.y()) / columns;
    const int nx = std::max(1, static_cast<int>(std::lround(size.x() / cell)));
    const int ny = std::max(1, static_cast<int>(std::lround(size.y() / cell)));
    std::vector<std::vector<std::pair<double, double>>> pieces(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
    const double dx = size.x() / nx;
    const double dy = size.y() / ny;
    for (std::size_t k = 0; k < m.spheres.size(); ++k) {
        const Vec3 c = m.spheres.position.at(k) - region.min();
        const double r = m.spheres.radius[k];
        const auto first = [&](double low, double step) { return std::max(0, static_cast<int>(std::ceil(low / step - 0.5))); };
        const auto last = [&](double high, double step, int n) { return std::min(n - 1, static_cast<int>(std::floor(high / step - 0.5))); };
        for (int i = first(c.x() - r, dx); i <= last(c.x() + r, dx, nx); ++i) {
            for (int j = first(c.y() - r, dy); j <= last(c.y() + r, dy, ny); ++j) {
                const double x = (i + 0.5) * dx - c.x();
                const double y = (j + 0.5) * dy - c.y();
                const double half = std::sqrt(std::max(0.0, r * r - x * x - y * y));
                const double low = std::max(0.0, c.z() - half);
                const double high = std::min(size.z(), c.z() + half);
                if (high > low) {
                    pieces[static_cast<std::size_t>(i) * static_cast<std::size_t>(ny) + static_cast<std::size_t>(j)].emplace_back(low,
                                                                                                                                  high);
                }
            }
        }
    }
    double filled = 0.0;
    for (auto& column : pieces) {
        std::sort(column.begin(), column.end());
        double reached = 0.0;
        for (const auto& [low, high] : column) {
            filled += std::max(0.0, high - std::max(low, reached));
            reached = std::max(reached, high);
        }
    }
    out.solid_fraction = filled / (static_cast<double>(pieces.size()) * size.z());
    return out;
}

} // namespace proveta
