// A scene: particles that fall, pour and flow among surfaces that move, as its user describes it in JSON.
#pragma once

#include <string>
#include <vector>

#include "core/input/json.hpp"
#include "lab/scene/body_input.hpp"
#include "lab/scene/motion.hpp"
#include "materials/card.hpp"
#include "specimens/specimen.hpp"

namespace proveta {

/// A material of the scene by its name.
struct NamedMaterial {
    std::string name;
    MaterialInput material;
};

/// A surface: made by the program or read from a file, put into place, moving.
struct SurfaceInput {
    std::string name;
    std::string shape = "plane";
    std::vector<double> size{}; ///< of a plane (two numbers) or a box (three), m; it has no default
    double radius = 0.0;        ///< m
    input::NumberOrWord top_radius{0.0, "radius"};
    double inner_radius = 0.0;
    double height = 0.0;
    double pitch = 0.0;
    std::int64_t sides = 48;
    std::int64_t rows = 1;
    std::int64_t rings = 1;
    std::int64_t cuts = 3;
    std::string ends = "none";
    std::string file;
    double scale = 1.0;
    std::vector<double> position{0.0, 0.0, 0.0};
    std::vector<double> turned{0.0, 0.0, 0.0}; ///< rad, about x, then y, then z
    std::string material;
    double friction = 0.5;
    MotionInput motion;
};

/// A kind of particles and how they come into the scene.
struct ParticleInput {
    std::string name;
    std::string material;
    std::string form = "sphere";
    double size = 0.01; ///< m
    double deviation = 0.0;
    double smallest = 0.5;
    double largest = 1.5;
    std::vector<GradingPoint> grading;
    // stones
    double elongation = 0.75;
    double flatness = 0.75;
    std::int64_t facets = 14;
    std::int64_t forms = 8;
    std::int64_t spheres = 16;
    std::string file;
    // placing
    std::int64_t count = 100;
    std::string place = "pour";
    std::vector<double> from{0.0, 0.0, 0.0};
    std::vector<double> to{0.0, 0.0, 0.0};
    std::vector<double> velocity{0.0, 0.0, 0.0};
    input::NumberOrWord rate{0.0, "as_room"};
    double begin = 0.0;
};

/// A region that takes particles out.
struct OutletInput {
    std::string name;
    std::vector<double> from{0.0, 0.0, 0.0};
    std::vector<double> to{0.0, 0.0, 0.0};
};

/// When the scene is over.
struct SceneStop {
    double time = 1.0; ///< s
    double rest = 0.0; ///< m/s; 0: not used
};

struct SceneNumerics {
    input::NumberOrWord time_step{0.0, "auto"};
    std::string above_bound = "refuse";
    double safety = 0.9;
    double impact_steps = 20.0;
    input::NumberOrWord skin{0.0, "auto"};
    double largest_overlap = 0.01;
    double damping = 0.0;
};

struct SceneOutput {
    std::int64_t samples = 200;
    std::int64_t fields = 10;
    double checkpoint_every = 30.0; ///< s of wall time; 0: only at the end
};

/// A scene as read, every default filled in.
struct Scene {
    std::string title;
    std::vector<double> gravity{0.0, 0.0, -9.81};
    std::vector<NamedMaterial> materials;
    std::vector<SurfaceInput> surfaces;
    std::vector<BodyInput> bodies;
    std::vector<ParticleInput> particles;
    std::vector<OutletInput> outlets;
    std::vector<OutletInput> measures;
    std::int64_t seed = 1;
    SceneStop stop;
    SceneNumerics numerics;
    SceneOutput output;

    std::string source; ///< the scene's file
    std::string folder; ///< where its relative file names start

    /// Index of a material by name; the first one for an empty name.
    [[nodiscard]] int material(const std::string& name) const;
};

void declare(input::Visitor& v, Scene& scene);

/// Reads a scene, or the manifest of an earlier one. Throws InputError with every problem.
Scene read_scene(const std::string& file, const std::vector<std::string>& settings);

/// The scene with every value filled in, SI units, its files named absolutely; reading it gives the same scene.
input::Json resolved(const Scene& scene);

/// The files that are read again whenever the scene is set up, absolutely: surfaces, bodies, forms, tables of places.
std::vector<std::string> files_of(const Scene& scene);

/// JSON schema of scenes.
input::Json scene_schema();

} // namespace proveta
