// Fields and pictures of a scene.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/scene/scene_samples.hpp"
#include "lab/scene/vectors.hpp"

namespace proveta {

namespace {

// The plane of a picture and what it shows.
struct SliceView {
    int right, up, out;
    double middle; // of the third component, m
    double sense;  // +1: `up` grows upwards
    Eigen::AlignedBox3d shown;

    [[nodiscard]] double x(const Vec3& p) const { return p[right] - shown.center()[right]; }
    [[nodiscard]] double y(const Vec3& p) const { return sense > 0.0 ? p[up] - shown.min()[up] : shown.max()[up] - p[up]; }
};

// Where the edges of a polygon go through the plane.
void cut_polygon(const std::vector<Vec3>& corners, const SliceView& view, std::vector<report::PictureLine>& lines) {
    std::vector<Vec3> through;
    const std::size_t n = corners.size();
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3& a = corners[k];
        const Vec3& b = corners[(k + 1) % n];
        const double da = a[view.out] - view.middle;
        const double db = b[view.out] - view.middle;
        if ((da < 0.0) != (db < 0.0)) {
            through.emplace_back(a + (b - a) * (da / (da - db)));
        }
    }
    if (through.size() == 2) {
        lines.push_back({view.x(through[0]), view.y(through[0]), view.x(through[1]), view.y(through[1]), 0, 0.3});
    }
}

void cut_face(const Surface& surface, std::size_t face, const SliceView& view, std::vector<report::PictureLine>& lines) {
    const SurfaceMesh& mesh = surface.geometry.mesh;
    std::vector<Vec3> corners;
    for (std::size_t k = 0; k < mesh.corners(face); ++k) {
        corners.push_back(surface.to_space(mesh.at(face, k)));
    }
    cut_polygon(corners, view, lines);
}

// The same of a skin as it is.
void cut_skin(const Skin& skin, const SliceView& view, std::vector<report::PictureLine>& lines) {
    for (std::size_t t = 0; t < skin.triangles(); ++t) {
        const auto v = skin.geometry().corners(static_cast<std::uint32_t>(t));
        cut_polygon({v.begin(), v.end()}, view, lines);
    }
}

} // namespace

report::Geometry particle_fields(const Model& m) {
    report::Geometry g;
    g.points = m.spheres.position;
    VectorField force(m.spheres.size());
    for (std::size_t k = 0; k < m.contacts.size(); ++k) {
        force.add(static_cast<std::size_t>(m.contacts.i[k]), m.contacts.force.at(k));
        force.add(static_cast<std::size_t>(m.contacts.j[k]), -m.contacts.force.at(k));
    }
    for (const auto& surface : m.walls.surfaces) {
        for (const auto& block : surface.touches) {
            for (const auto& touch : block) {
                force.add(static_cast<std::size_t>(touch.sphere), touch.force);
            }
        }
    }
    for (const auto& body : m.walls.bodies) {
        for (const auto& block : body.touches) {
            for (const auto& touch : block) {
                force.add(static_cast<std::size_t>(touch.sphere), touch.force);
            }
        }
    }
    g.point_arrays = {{"radius", 1, m.spheres.radius},
                      {"velocity", 3, report::interleaved(m.spheres.velocity)},
                      {"spin", 3, report::interleaved(m.spheres.spin)},
                      {"force", 3, report::interleaved(force)},
                      {"particle", 1, report::as_numbers(m.spheres.id)},
                      {"kind", 1, report::as_numbers(m.spheres.group)}};
    return g;
}

report::Geometry surface_fields(const Model& m) {
    report::Geometry g;
    std::vector<double> number;
    for (std::size_t s = 0; s < m.walls.surfaces.size(); ++s) {
        const Surface& surface = m.walls.surfaces[s];
        const SurfaceMesh& mesh = surface.geometry.mesh;
        const auto begin = static_cast<std::int64_t>(g.points.size());
        for (const auto& v : mesh.vertex) {
            g.points.push_back(surface.to_space(v));
        }
        for (std::size_t f = 0; f < mesh.faces(); ++f) {
            g.cells.emplace_back();
            for (std::size_t k = 0; k < mesh.corners(f); ++k) {
                g.cells.back().push_back(begin + mesh.corner[mesh.first[f] + k]);
            }
            number.push_back(static_cast<double>(s));
        }
    }
    g.cell_arrays = {{"surface", 1, number}};
    return g;
}

Eigen::AlignedBox3d stage_of(const Scene& scene, const Walls& walls) {
    Eigen::AlignedBox3d regions;
    for (const auto& p : scene.particles) {
        regions.extend(box_of(p));
    }
    for (const auto* list : {&scene.outlets, &scene.measures}) {
        for (const auto& region : *list) {
            regions.extend(box_of(region));
        }
    }
    for (const auto& body : walls.bodies) {
        Eigen::AlignedBox3d own;
        for (const Vec3& v : body.solid.position) {
            own.extend(v);
        }
        const Vec3 give = Vec3::Constant(0.15 * own.diagonal().norm()); // it will yield
        regions.extend(own.min() - give).extend(own.max() + give);
    }
    Eigen::AlignedBox3d stage = regions;
    for (const auto& surface : walls.surfaces) {
        for (const auto& v : surface.geometry.mesh.vertex) {
            stage.extend(surface.to_space(v));
        }
    }
    const Vec3 around = Vec3::Constant(0.5 * regions.diagonal().norm()); // surfaces may reach far beyond what happens
    return stage.intersection({regions.min() - around, regions.max() + around});
}

std::vector<report::Picture> scene_slices(const Model& m, const Vec3& gravity, const Eigen::AlignedBox3d& stage, const std::string& when) {
    int down = 2;
    if (!gravity.isZero()) {
        gravity.cwiseAbs().maxCoeff(&down);
    }
    const double sense = gravity[down] > 0.0 ? -1.0 : 1.0;
    const double half = mean_radius(m.spheres);
    const auto newest =
        m.spheres.size() == 0 ? 1.0 : static_cast<double>(*std::max_element(m.spheres.id.begin(), m.spheres.id.end())) + 1.0;
    std::vector<report::Picture> out;
    for (const int side : {(down + 1) % 3, (down + 2) % 3}) {
        SliceView view{side, down, 3 - side - down, stage.center()[3 - side - down], sense, stage};
        report::Picture p;
        for (const auto& surface : m.walls.surfaces) {
            for (std::size_t f = 0; f < surface.geometry.mesh.faces(); ++f) {
                cut_face(surface, f, view, p.lines);
            }
        }
        for (const auto& body : m.walls.bodies) {
            cut_skin(body.skin, view, p.lines);
        }
        for (std::size_t k = 0; k < m.spheres.size(); ++k) {
            const Vec3 at = m.spheres.position.at(k);
            if (std::fabs(at[view.out] - view.middle) < half) {
                p.dots.push_back({view.x(at), view.y(at), m.spheres.radius[k], (static_cast<double>(m.spheres.id[k]) + 0.5) / newest});
            }
        }
        p.title = fmt::format("{}, across {}", when, "xyz"[view.out]);
        p.caption = "Slice through the middle, two mean radii thick. Shade: the order in which they came, the last ones "
                    "darkest.";
        p.width = view.shown.sizes()[side];
        p.height = view.shown.sizes()[down];
        out.push_back(std::move(p));
    }
    return out;
}

} // namespace proveta
