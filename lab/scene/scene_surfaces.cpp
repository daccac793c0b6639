#include "lab/scene/scene_surfaces.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "core/boundaries/surface_shapes.hpp"
#include "lab/scene/vectors.hpp"
#include "specimens/memory.hpp"
#include "specimens/surface_import.hpp"

namespace proveta {

namespace {

ImportedSurface load(const Scene& scene, const std::string& file, double scale) {
    return import_surface((std::filesystem::path(scene.folder) / file).string(), scale);
}

SurfaceMesh made(const SurfaceInput& s) {
    const auto whole = [](std::int64_t n) { return static_cast<int>(n); };
    if (s.shape == "plane") {
        return plane_surface(s.size[0], s.size[1]);
    }
    if (s.shape == "box") {
        return box_surface({s.size[0], s.size[1], s.size[2]});
    }
    if (s.shape == "disc") {
        return disc_surface(s.radius, whole(s.sides));
    }
    if (s.shape == "sphere") {
        return sphere_surface(s.radius, whole(s.cuts));
    }
    if (s.shape == "helix") {
        return helix_surface(s.inner_radius, s.radius, s.pitch, s.height, whole(s.sides), whole(s.rings));
    }
    const double top = s.top_radius.word.empty() ? s.top_radius.number : s.radius;
    return cylinder_surface(s.radius, top, s.height, whole(s.sides), s.ends == "bottom" || s.ends == "both",
                            s.ends == "top" || s.ends == "both", whole(s.rows));
}

// About how many faces that makes.
double faces_of(const SurfaceInput& s) {
    const auto sides = static_cast<double>(s.sides);
    if (s.shape == "sphere") {
        return 20.0 * std::pow(4.0, static_cast<double>(s.cuts));
    }
    if (s.shape == "helix") {
        return 2.0 * sides * static_cast<double>(s.rings) * (s.pitch != 0.0 ? std::fabs(s.height / s.pitch) : 1.0);
    }
    return s.shape == "cylinder" ? sides * static_cast<double>(s.rows) : s.shape == "disc" ? sides : 6.0;
}

// Complains where the surfaces so far take more memory than there is, before they are made.
bool have_room(double faces, const Scene& scene, std::size_t k, input::Problems& problems) {
    constexpr double bytes_a_face = 600.0; // measured on cylinders
    const double most = static_cast<double>(available_memory()) / bytes_a_face;
    if (faces <= most) {
        return true;
    }
    problems.push_back({scene.source, fmt::format("/surfaces/{}", k), fmt::format("{:.3g} faces with those before", faces),
                        fmt::format("at most {:.3g}, for which there is memory", most), "fewer sides, rows, rings or cuts"});
    return false;
}

// Complains of a mesh that reaches so far that nothing can be calculated there.
bool within_reach(const SurfaceMesh& mesh, const Scene& scene, std::size_t k, input::Problems& problems) {
    for (const auto& v : mesh.vertex) {
        if (!(v.array().abs() <= farthest_corner).all()) { // nor what is no number
            problems.push_back({scene.source, fmt::format("/surfaces/{}", k),
                                fmt::format("a corner at {:.4g} {:.4g} {:.4g} m", v.x(), v.y(), v.z()),
                                fmt::format("corners within {:g} m", farthest_corner), ""});
            return false;
        }
    }
    return true;
}

// Turns the mesh and puts it where it belongs, as its own frame sees it: about the pivot of its motion, which becomes the origin.
Vec3 put_into_place(const SurfaceInput& s, SurfaceMesh& mesh) {
    const Eigen::Quaterniond turn = attitude(s.turned);
    const Vec3 pivot = s.motion.about_what == "point" ? vector(s.motion.about) : vector(s.position);
    for (auto& v : mesh.vertex) {
        v = turn * v + vector(s.position) - pivot;
    }
    return pivot;
}

} // namespace

std::vector<Surface> make_surfaces(const Scene& scene, const std::vector<Material>& materials, std::vector<std::string>& notes) {
    std::vector<Surface> out;
    input::Problems problems;
    double faces = 0.0;
    for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
        const SurfaceInput& s = scene.surfaces[k];
        SurfaceMesh mesh;
        if (s.shape == "file") {
            try {
                ImportedSurface read = load(scene, s.file, s.scale);
                for (const auto& note : read.notes) {
                    notes.push_back(fmt::format("Surface \"{}\": {}.", s.name, note));
                }
                mesh = std::move(read.mesh);
                say_size(fmt::format("Surface \"{}\"", s.name), mesh.vertex, notes);
            } catch (const std::runtime_error& error) {
                problems.push_back({scene.source, fmt::format("/surfaces/{}/file", k), "\"" + s.file + "\"", "a surface", error.what()});
                continue;
            }
        } else {
            faces += faces_of(s);
            if (!have_room(faces, scene, k, problems)) {
                break;
            }
            mesh = made(s);
        }
        const Vec3 origin = put_into_place(s, mesh);
        if (!within_reach(mesh, scene, k, problems)) {
            continue;
        }
        out.emplace_back(s.name, std::move(mesh), materials[static_cast<std::size_t>(scene.material(s.material))], s.friction);
        out.back().origin = origin;
    }
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
    return out;
}

SurfaceMesh closed_surface(const Scene& scene, const std::string& file, const std::string& path) {
    std::string why;
    try {
        ImportedSurface read = load(scene, file, 1.0);
        if (read.state.closed()) {
            return std::move(read.mesh);
        }
        why = read.state.notes.empty() ? "it is not closed" : read.state.notes.front();
    } catch (const std::runtime_error& error) {
        why = error.what();
    }
    throw input::InputError({{scene.source, path, "\"" + file + "\"", "a closed surface without faces inside each other", why}});
}

} // namespace proveta
