#include "lab/scene/scene_surfaces.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "core/boundaries/surface_shapes.hpp"
#include "lab/scene/vectors.hpp"
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
            } catch (const std::runtime_error& error) {
                problems.push_back({scene.source, fmt::format("/surfaces/{}/file", k), "\"" + s.file + "\"", "a surface", error.what()});
                continue;
            }
        } else {
            mesh = made(s);
        }
        const Vec3 origin = put_into_place(s, mesh);
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
