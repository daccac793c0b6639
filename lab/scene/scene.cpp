#include "lab/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "lab/deck.hpp"
#include "lab/provenance.hpp"
#include "lab/scene/scene_check.hpp"

namespace proveta {

using input::above;
using input::any_number;
using input::at_least;
using input::between;
using input::Json;
using input::Unit;

void declare(input::Visitor& v, NamedMaterial& m) {
    v.text("name", m.name, "by which surfaces and particles call it");
    v.section("material", m.material,
              "a card and what to change in it; loose particles follow its contact_law, contact_restitution, mu_d "
              "and rolling_friction");
}

void declare(input::Visitor& v, SurfaceInput& s) {
    v.text("name", s.name, "by which results call it");
    v.choice("shape", s.shape,
             {{"plane", "a rectangle across z about its position"},
              {"box", "a box about its position"},
              {"disc", "a disc across z about its position"},
              {"cylinder", "about z from its position up: a cylinder, a cone, a funnel"},
              {"sphere", "a sphere about its position"},
              {"helix", "a screw's blade about z from its position up"},
              {"file", "an STL, OBJ, PLY, VTK or VTP file"}},
             "its form before it is turned and put into place");
    const auto is = [&](std::initializer_list<const char*> shapes) {
        return v.wants_all() || std::any_of(shapes.begin(), shapes.end(), [&](const char* shape) { return s.shape == shape; });
    };
    if (is({"plane", "box"})) {
        v.numbers("size", s.size, s.shape == "plane" && !v.wants_all() ? 2 : 0, Unit::length, above(0),
                  "lengths along x and y; of a box along x, y and z");
    }
    if (is({"disc", "cylinder", "sphere", "helix"})) {
        v.number("radius", s.radius, Unit::length, at_least(0), "radius; of a cylinder at its lower end, of a blade its outer edge");
    }
    if (is({"cylinder"})) {
        v.number_or_word("top_radius", s.top_radius, {{"radius", "the same as below"}}, Unit::length, at_least(0),
                         "radius at the upper end; 0 on one end: a cone");
        v.choice("ends", s.ends, {{"none", "open"}, {"bottom", "closed below"}, {"top", "closed above"}, {"both", "closed"}}, "its ends");
        v.integer("rows", s.rows, 1, 10000, "quadrilaterals along its height");
    }
    if (is({"cylinder", "helix"})) {
        v.number("height", s.height, Unit::length, at_least(0), "length along z");
    }
    if (is({"helix"})) {
        v.number("inner_radius", s.inner_radius, Unit::length, at_least(0), "radius of the blade's inner edge");
        v.number("pitch", s.pitch, Unit::length, any_number(), "rise a turn; negative: the other way round");
        v.integer("rings", s.rings, 1, 1000, "quadrilaterals along the radius, each cut in two");
    }
    if (is({"disc", "cylinder", "helix"})) {
        v.integer("sides", s.sides, 3, 10000, "corners around; of a blade quadrilaterals a turn");
    }
    if (is({"sphere"})) {
        v.integer("cuts", s.cuts, 0, 7, "how often the faces of an icosahedron are cut in four");
    }
    if (is({"file"})) {
        v.text("file", s.file, "file name, relative to the scene's");
        v.number("scale", s.scale, Unit::none, above(0), "metres a unit of the file");
    }
    v.numbers("position", s.position, 3, Unit::length, any_number(), "where its origin is put, x y z");
    v.numbers("turned", s.turned, 3, Unit::angle, any_number(), "turned about the axes x, then y, then z, before it is put there");
    v.text("material", s.material, "its material by name; empty: the first one");
    v.number("friction", s.friction, Unit::none, between(0, 10), "Coulomb friction of particles on it");
    v.section("motion", s.motion, "how it moves");
}

void declare(input::Visitor& v, ParticleInput& p) {
    v.text("name", p.name, "by which results call them");
    v.text("material", p.material, "their material by name; empty: the first one");
    v.choice("form", p.form,
             {{"sphere", "spheres"},
              {"stone", "clusters of spheres: convex stones with plane facets, no two forms alike"},
              {"file", "clusters of spheres that fill a closed surface from a file"}},
             "what a particle is");
    v.number("size", p.size, Unit::length, above(0), "diameter; of a cluster that of the sphere of its volume");
    v.number("deviation", p.deviation, Unit::none, between(0, 1), "relative standard deviation of the size");
    v.number("smallest", p.smallest, Unit::none, between(0.01, 1), "smallest size over the mean");
    v.number("largest", p.largest, Unit::none, between(1, 100), "largest size over the mean");
    v.list("grading", p.grading,
           "sieve curve in place of size and deviation: points, or the name of a table of sieve sizes and what passes them");
    const auto is = [&](const char* form) { return v.wants_all() || p.form == form; };
    if (is("stone")) {
        v.number("elongation", p.elongation, Unit::none, between(0.1, 1), "intermediate over longest axis (Zingg)");
        v.number("flatness", p.flatness, Unit::none, between(0.1, 1), "shortest over intermediate axis (Zingg)");
        v.integer("facets", p.facets, 6, 200, "plane facets that a stone is cut by; the fewer, the more angular");
        v.integer("forms", p.forms, 1, 1000, "different stones, which the particles take in turn");
    }
    if (is("file")) {
        v.text("file", p.file, "a closed surface; the file's unit does not matter, size counts");
    }
    if (is("stone") || is("file")) {
        v.integer("spheres", p.spheres, 1, 10000, "of a cluster at most");
    }
    v.integer("count", p.count, 1, 100000000, "particles that come in all");
    v.choice("place", p.place,
             {{"pour", "into the box from..to, at random, touching nothing, as there is room or at a rate"},
              {"grow", "all at the start: grown until they fill the box from..to at random; what would reach into a surface is left out"}},
             "how they come in");
    v.numbers("from", p.from, 3, Unit::length, any_number(), "corner of the box that they come into");
    v.numbers("to", p.to, 3, Unit::length, any_number(), "opposite corner");
    v.numbers("velocity", p.velocity, 3, Unit::velocity, any_number(), "with which they come");
    if (v.wants_all() || p.place == "pour") {
        v.number_or_word("rate", p.rate, {{"as_room", "as soon as there is room"}}, Unit::rate, above(0), "particles a second");
        v.number("begin", p.begin, Unit::time, at_least(0), "when the first may come");
    }
}

void declare(input::Visitor& v, OutletInput& o) {
    v.text("name", o.name, "by which results call it");
    v.numbers("from", o.from, 3, Unit::length, any_number(), "corner of a box");
    v.numbers("to", o.to, 3, Unit::length, any_number(), "opposite corner");
}

void declare(input::Visitor& v, SceneStop& s) {
    v.number("time", s.time, Unit::time, above(0), "at the latest");
    v.number("rest", s.rest, Unit::velocity, at_least(0),
             "sooner, once all particles are there, no surface moves and the particles' root mean square speed is below this; 0: not so");
}

void declare(input::Visitor& v, SceneNumerics& n) {
    v.number_or_word("time_step", n.time_step,
                     {{"auto", "safety times the stable step of a sphere with twelve neighbours, and shorter where impacts ask for that"}},
                     Unit::time, above(0), "time step; shortened where the contacts at hand ask for that");
    v.number("impact_steps", n.impact_steps, Unit::none, between(0, 1000),
             "steps that an impact takes at least under the automatic step, 1 + xi times as many with a damping ratio xi: 20 give "
             "restitutions to half a per cent; 0: only stability counts");
    v.choice("above_bound", n.above_bound,
             {{"refuse", "a time_step above the bound on the stable one is refused, and shortened where new contacts lower the bound"},
              {"keep", "it is kept: the bound is cautious for loose matter; look at the energy balance"}},
             "what becomes of a time_step given here");
    v.number("safety", n.safety, Unit::none, {0.0, 1.0, true, false}, "fraction of the stable step");
    v.number_or_word("skin", n.skin, {{"auto", "chosen on the way so that searching and listing take least time"}}, Unit::none,
                     between(0.01, 2), "skin of the neighbour lists over the mean radius");
    v.number("largest_overlap", n.largest_overlap, Unit::none, between(1e-6, 0.5),
             "overlap over the radius up to which Hertzian contacts are reckoned stable in advance");
    v.number("damping", n.damping, Unit::none, {0.0, 1.0, false, true},
             "background damping: share of the unbalanced force against the velocity (5.18-5.19); 0: only contacts dissipate");
}

void declare(input::Visitor& v, SceneOutput& o) {
    v.integer("samples", o.samples, 10, 1000000, "rows of curve.csv");
    v.integer("fields", o.fields, 0, 10000, "VTK field files; 0: none");
    v.number("checkpoint_every", o.checkpoint_every, Unit::time, at_least(0), "wall time between checkpoints; 0: only at the end");
}

void declare(input::Visitor& v, Scene& s) {
    v.text("scene", s.title, "what it is: title of the report");
    v.numbers("gravity", s.gravity, 3, Unit::acceleration, any_number(), "x y z");
    v.list("materials", s.materials, "the materials by name");
    v.list("surfaces", s.surfaces, "rigid surfaces");
    v.list("bodies", s.bodies, "deformable bodies and membranes");
    v.list("particles", s.particles, "kinds of particles and how they come in");
    v.list("outlets", s.outlets, "boxes that take out every particle whose centre comes in");
    v.list("measures", s.measures, "boxes whose solid fraction and coordination are reported at the end");
    v.integer("seed", s.seed, 0, 1000000000, "of all that is random");
    v.section("stop", s.stop, "when the scene is over");
    v.section("numerics", s.numerics, "how the calculation is carried out");
    v.section("output", s.output, "what is written");
}

int Scene::material(const std::string& name) const {
    for (std::size_t k = 0; k < materials.size() && !name.empty(); ++k) {
        if (materials[k].name == name) {
            return static_cast<int>(k);
        }
    }
    return 0;
}

namespace {

// What a manifest promises to repeat it cannot with other files.
void refuse_changed(const Json& hashes, const std::string& manifest, input::Problems& problems) {
    if (!hashes.is_object()) {
        return;
    }
    for (const auto& [name, then] : hashes.items()) {
        const std::string now = hash_of_file(name);
        if (then.is_string() && now != then.get<std::string>()) {
            problems.push_back({manifest, "/files_read_again", name + (now.empty() ? ", which has gone" : ", whose hash is " + now),
                                "the file that the scene was played with, of hash " + then.get<std::string>(),
                                "with another one it is another scene: give the scene's own file instead of the manifest"});
        }
    }
}

} // namespace

Scene read_scene(const std::string& file, const std::vector<std::string>& settings) {
    Json json = input::load_json(file);
    input::Problems problems;
    if (json.is_object() && json.contains("proveta_scene_manifest") && json.contains("scene")) {
        refuse_changed(json.value("files_read_again", Json::object()), file, problems);
        json = Json(json["scene"]);
    }
    apply_settings(json, settings);
    Scene scene;
    scene.source = file;
    scene.folder = std::filesystem::absolute(file).parent_path().string();
    if (!json.is_object() || !json.contains("scene")) {
        problems.push_back(
            {file, "/scene", "no scene", "a title, such as \"Spheres in a box\"", "decks of tests are run by `proveta run`"});
    }
    if (json.is_object() && json.contains("materials") && json["materials"].is_array() && json["materials"].size() <= 1000) {
        scene.materials.resize(json["materials"].size());
        for (std::size_t k = 0; k < scene.materials.size(); ++k) {
            const Json& item = json["materials"][k];
            const Json material = item.is_object() && item.contains("material") ? item["material"] : Json::object();
            preload(material, scene.materials[k].material, scene.folder, file, fmt::format("/materials/{}/material", k), problems);
        }
    }
    if (json.is_object() && json.contains("particles")) {
        read_grading_files(json["particles"], scene.folder, file, "/particles", problems);
    }
    input::read(json, scene, file, "", problems);
    check_scene(scene, problems);
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
    return scene;
}

namespace {

// Calls use(name) for the name of each file that the scene has, to be read or changed.
template <class Use> void each_file(Scene& scene, const Use& use) {
    const auto given = [&](std::string& name) {
        if (!name.empty()) {
            use(name);
        }
    };
    for (auto& s : scene.surfaces) {
        given(s.file);
        given(s.motion.file);
    }
    for (auto& b : scene.bodies) {
        given(b.file);
    }
    for (auto& p : scene.particles) {
        given(p.file);
    }
}

// The scene with its files named absolutely.
Scene absolute(Scene scene) {
    each_file(scene, [&](std::string& name) {
        name = std::filesystem::absolute(std::filesystem::path(scene.folder) / name).lexically_normal().string();
    });
    return scene;
}

} // namespace

std::vector<std::string> files_of(const Scene& scene) {
    Scene copy = absolute(scene);
    std::vector<std::string> out;
    each_file(copy, [&](const std::string& name) { out.push_back(name); });
    return out;
}

Json resolved(const Scene& scene) {
    Scene copy = absolute(scene);
    Json json = input::write(copy);
    for (auto& material : json["materials"]) {
        material["material"]["card"] = custom_card;
    }
    return json;
}

Json scene_schema() {
    Scene scene;
    Json schema = input::schema(scene);
    allow_grading_files(schema);
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
    schema["title"] = "Proveta scene";
    schema["required"] = {"scene"};
    return schema;
}

} // namespace proveta
