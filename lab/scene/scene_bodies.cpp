#include "lab/scene/scene_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "core/input/suggest.hpp"
#include "core/solids/solid_shapes.hpp"
#include "lab/controls/closing.hpp"
#include "lab/scene/vectors.hpp"
#include "specimens/solid_import.hpp"

namespace proveta {

using input::Unit;

void declare(input::Visitor& v, HoldInput& h) {
    v.text("group", h.group,
           "nodes by the name of their group in the mesh: x-, x+, y-, y+, z-, z+, side, rim, or a file's; empty: by the box");
    v.numbers("from", h.from, 3, Unit::length, input::any_number(), "corner of a box whose nodes are held, as they start in space");
    v.numbers("to", h.to, 3, Unit::length, input::any_number(), "opposite corner");
    v.text("axes", h.axes, "which components are held: letters of xyz");
    v.numbers("velocity", h.velocity, 3, Unit::velocity, input::any_number(), "with which they move along the held axes");
}

void declare(input::Visitor& v, BodyPressureInput& p) {
    v.number("pressure", p.pressure, Unit::pressure, input::any_number(), "on the whole skin, against its outer side; it follows the skin");
    v.number("ramp", p.ramp, Unit::time, input::at_least(0), "time in which it is brought up");
}

void declare(input::Visitor& v, BodyInput& b) {
    v.text("name", b.name, "by which results call it");
    v.choice("shape", b.shape,
             {{"box", "a solid box about its position"},
              {"cylinder", "a solid cylinder about z from its position up"},
              {"tube", "a membrane: the side of a cylinder about z from its position up"},
              {"sheet", "a membrane: a rectangle across z about its position"},
              {"sphere", "a membrane: a sphere about its position"},
              {"file", "a Gmsh (.msh) or VTK (.vtk, .vtu) file of tetrahedra and hexahedra, or of triangles: a membrane"}},
             "its form before it is turned and put into place");
    const auto is = [&](std::initializer_list<const char*> shapes) {
        return v.wants_all() || std::any_of(shapes.begin(), shapes.end(), [&](const char* shape) { return b.shape == shape; });
    };
    if (is({"box", "sheet"})) {
        v.numbers("size", b.size, b.shape == "box" && !v.wants_all() ? 3 : 0, Unit::length, input::above(0),
                  "lengths along x, y and z; of a sheet along x and y");
    }
    if (is({"cylinder", "tube", "sphere"})) {
        v.number("radius", b.radius, Unit::length, input::above(0), "radius");
    }
    if (is({"cylinder", "tube"})) {
        v.number("height", b.height, Unit::length, input::above(0), "length along z");
    }
    if (is({"box", "sheet", "cylinder", "tube", "sphere"})) {
        v.numbers(
            "cells", b.cells, 0, Unit::none, {1.0, 2000.0, false, false},
            "elements: of a box along x, y, z; of a sheet along x, y; of a cylinder across its core, rings around it, along z; of a tube "
            "around and along z; of a sphere how often an icosahedron's faces are cut in four");
    }
    if (is({"box"})) {
        v.choice("elements", b.elements, {{"hexahedra", "8 nodes, eight Gauss points"}, {"tetrahedra", "six a cell"}},
                 "what it is made of");
    }
    if (is({"file"})) {
        v.text("file", b.file, "file name, relative to the scene's");
        v.number("scale", b.scale, Unit::none, input::above(0), "metres a unit of the file");
    }
    v.numbers("position", b.position, 3, Unit::length, input::any_number(), "where its origin is put, x y z");
    v.numbers("turned", b.turned, 3, Unit::angle, input::any_number(), "turned about the axes x, then y, then z, before it is put there");
    v.numbers("velocity", b.velocity, 3, Unit::velocity, input::any_number(), "with which it starts");
    v.choice("law", b.law,
             {{"kirchhoff", "St. Venant and Kirchhoff: any rotation, small strain (4.34)"},
              {"neo_hookean", "any strain (4.37-4.39)"},
              {"j2", "von Mises plasticity at any strain (4.40-4.42)"}},
             "constitutive law");
    v.number("density", b.density, Unit::density, input::between(1e-3, 1e9), "without stress");
    v.number("young_modulus", b.young_modulus, Unit::pressure, input::above(0), "at small strain; contacts are reckoned with it too");
    v.number("poisson_ratio", b.poisson_ratio, Unit::none, {-1.0, 0.5, true, true}, "at small strain");
    if (v.wants_all() || b.law == "j2") {
        v.number("yield_stress", b.yield_stress, Unit::pressure, input::above(0), "true stress at which it yields first");
        v.number("hardening", b.hardening, Unit::pressure, input::at_least(0), "slope of true stress against plastic logarithmic strain");
    }
    v.number("mass_damping", b.mass_damping, Unit::rate, input::at_least(0), "Rayleigh's a1 (4.72)");
    v.number("stiffness_damping", b.stiffness_damping, Unit::time, input::at_least(0), "Rayleigh's a2 (4.72); shortens the step");
    v.number("thickness", b.thickness, Unit::length, input::above(0), "of a membrane");
    v.number("friction", b.friction, Unit::none, input::between(0, 10), "Coulomb friction of particles on it");
    v.number("restitution", b.restitution, Unit::none, {0.0, 1.0, true, false}, "of particles that meet it, by the contact alone");
    v.choice("coupling", b.coupling,
             {{"area_distributed", "forces are shared out over all faces that a sphere cuts, by areas (4.60-4.65)"},
              {"direct", "by the shape functions at the contact point (4.57)"}},
             "how contact forces reach the nodes");
    v.list("holds", b.holds, "nodes whose motion is given");
    v.list("pressures", b.pressures, "pressures on its skin");
}

namespace {

SolidMaterial material_of(const BodyInput& b) {
    SolidMaterial m;
    m.name = b.name;
    m.law = b.law == "kirchhoff" ? SolidLaw::kirchhoff : b.law == "j2" ? SolidLaw::j2 : SolidLaw::neo_hookean;
    m.density = b.density;
    m.young_modulus = b.young_modulus;
    m.poisson_ratio = b.poisson_ratio;
    m.yield_stress = b.yield_stress;
    m.hardening = b.hardening;
    m.mass_damping = b.mass_damping;
    m.stiffness_damping = b.stiffness_damping;
    return m;
}

int cell(const BodyInput& b, std::size_t k) { return static_cast<int>(std::lround(b.cells[std::min(k, b.cells.size() - 1)])); }

SolidMesh made(const BodyInput& b) {
    if (b.shape == "box") {
        return box_mesh({b.size[0], b.size[1], b.size[2]}, cell(b, 0), cell(b, 1), cell(b, 2), b.elements == "tetrahedra");
    }
    if (b.shape == "cylinder") {
        return cylinder_mesh(b.radius, b.height, cell(b, 0), cell(b, 1), cell(b, 2));
    }
    if (b.shape == "tube") {
        return tube_membrane(b.radius, b.height, cell(b, 0), cell(b, 1));
    }
    return b.shape == "sheet" ? sheet_membrane(b.size[0], b.size[1], cell(b, 0), cell(b, 1)) : sphere_membrane(b.radius, cell(b, 0));
}

void put_into_place(const BodyInput& b, SolidMesh& mesh) {
    const Eigen::Quaterniond turn = attitude(b.turned);
    for (auto& v : mesh.node) {
        v = turn * v + vector(b.position);
    }
}

// Nodes of a hold; what is wrong with it as a problem.
std::vector<std::uint32_t> held_nodes(const HoldInput& h, const SolidMesh& mesh, const std::string& source, const std::string& at,
                                      input::Problems& problems) {
    std::vector<std::uint32_t> out;
    if (!h.group.empty()) {
        std::vector<std::string> names;
        for (const auto& group : mesh.groups) {
            names.push_back(group.name);
            if (group.name == h.group) {
                out = group.node;
            }
        }
        if (out.empty()) {
            const std::string best = input::nearest(h.group, names);
            problems.push_back(
                {source, at + "/group", "\"" + h.group + "\"",
                 names.empty() ? "a box: the mesh has no groups" : fmt::format("one of the mesh's groups: {}", fmt::join(names, ", ")),
                 best.empty() ? "" : "did you mean \"" + best + "\"?"});
        }
        return out;
    }
    const Eigen::AlignedBox3d box(vector(h.from).cwiseMin(vector(h.to)), vector(h.from).cwiseMax(vector(h.to)));
    const double slack = 1e-9 * (1.0 + box.diagonal().norm());
    for (std::size_t k = 0; k < mesh.node.size(); ++k) {
        if (box.exteriorDistance(mesh.node[k]) <= slack) {
            out.push_back(static_cast<std::uint32_t>(k));
        }
    }
    if (out.empty()) {
        Eigen::AlignedBox3d all;
        for (const auto& v : mesh.node) {
            all.extend(v);
        }
        problems.push_back({source, at, "a box without a node of the body", "a box that holds some of its nodes",
                            fmt::format("the body reaches from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) m", all.min().x(),
                                        all.min().y(), all.min().z(), all.max().x(), all.max().y(), all.max().z())});
    }
    return out;
}

void hold(const BodyInput& b, const std::string& source, const std::string& at, Solid& solid, input::Problems& problems) {
    for (std::size_t k = 0; k < b.holds.size(); ++k) {
        const HoldInput& h = b.holds[k];
        NodeHold out;
        out.name = h.group.empty() ? fmt::format("hold_{}", k + 1) : h.group;
        for (std::size_t c = 0; c < 3; ++c) {
            out.axes[c] = h.axes.find("xyz"[c]) != std::string::npos;
        }
        const auto same = std::count_if(solid.holds.begin(), solid.holds.end(), [&](const NodeHold& other) {
            return other.name == out.name || other.name.rfind(out.name + "_", 0) == 0;
        });
        out.name += same > 0 ? fmt::format("_{}", same + 1) : "";
        out.velocity = vector(h.velocity);
        out.node = held_nodes(h, solid.mesh(), source, fmt::format("{}/holds/{}", at, k), problems);
        solid.holds.push_back(std::move(out));
    }
}

// The whole skin; quadrilaterals along both diagonals, so that the pressure keeps their symmetry.
void press(const BodyInput& b, Solid& solid) {
    const auto skin = skin_of(solid.mesh());
    for (std::size_t k = 0; k < b.pressures.size(); ++k) {
        NodePressure whole{0.0, {}, 1.0};
        NodePressure halves{0.0, {}, 0.5};
        for (const auto& f : skin) {
            const auto& n = f.node;
            if (f.quadrilateral) {
                halves.facet.insert(halves.facet.end(), {{n[0], n[1], n[2]}, {n[0], n[2], n[3]}, {n[0], n[1], n[3]}, {n[1], n[2], n[3]}});
            } else {
                whole.facet.push_back({n[0], n[1], n[2]});
            }
        }
        solid.pressures.push_back(std::move(whole));
        solid.pressures.push_back(std::move(halves));
    }
}

} // namespace

std::vector<Deformable> make_bodies(const Scene& scene, const std::vector<Material>& materials, std::vector<std::string>& notes) {
    std::vector<Deformable> out;
    input::Problems problems;
    for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
        const BodyInput& b = scene.bodies[k];
        const std::string at = fmt::format("/bodies/{}", k);
        try {
            SolidMesh mesh;
            if (b.shape == "file") {
                ImportedSolid read = import_solid((std::filesystem::path(scene.folder) / b.file).string(), b.scale);
                for (const auto& note : read.notes) {
                    notes.push_back(fmt::format("Body \"{}\": {}.", b.name, note));
                }
                mesh = std::move(read.mesh);
                say_size(fmt::format("Body \"{}\"", b.name), mesh.node, notes);
            } else {
                mesh = made(b);
            }
            put_into_place(b, mesh);
            const bool membrane = !mesh.membranes.empty();
            Solid solid(b.name, std::move(mesh), material_of(b), b.thickness);
            std::fill(solid.velocity.begin(), solid.velocity.end(), vector(b.velocity));
            hold(b, scene.source, at, solid, problems);
            press(b, solid);
            Material surface = materials.front(); // the particles' law, with this body's numbers
            surface.name = b.name;
            surface.young_modulus = b.young_modulus;
            surface.poisson_ratio = b.poisson_ratio;
            surface.contact_restitution = b.restitution;
            out.emplace_back(std::move(solid), surface, b.friction, b.coupling == "direct" ? Coupling::direct : Coupling::area_distributed,
                             membrane ? 0.0 : 1.0);
        } catch (const std::runtime_error& error) {
            problems.push_back({scene.source, at + "/file", "\"" + b.file + "\"", "a mesh of a deformable body", error.what()});
        } catch (const std::invalid_argument& error) {
            problems.push_back({scene.source, at, error.what(), "a mesh that can be calculated with", ""});
        }
    }
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
    return out;
}

void drive_bodies(const Scene& scene, double time, std::vector<Deformable>& bodies) {
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        auto& pressures = bodies[k].solid.pressures;
        for (std::size_t p = 0; p < pressures.size(); ++p) { // two a pressure of the input, see `press`
            const BodyPressureInput& in = scene.bodies[k].pressures[p / 2];
            pressures[p].value = in.pressure * (in.ramp > 0.0 ? smooth_start(time, in.ramp) : 1.0);
        }
    }
}

bool still_driven(const Deformable& body, double time, const Scene& scene, std::size_t number) {
    const BodyInput& in = scene.bodies[number];
    const bool held = std::any_of(in.holds.begin(), in.holds.end(), [](const HoldInput& h) { return !vector(h.velocity).isZero(); });
    const bool pressed = std::any_of(in.pressures.begin(), in.pressures.end(), [&](const BodyPressureInput& p) { return time < p.ramp; });
    const auto& v = body.solid.velocity;
    return held || pressed || std::any_of(v.begin(), v.end(), [&](const Vec3& node) { return node.norm() > scene.stop.rest; });
}

void check_body(const BodyInput& b, const std::string& source, const std::string& at, input::Problems& problems) {
    const auto wants = [&](const char* key, std::size_t found, std::size_t numbers) {
        if (found != numbers) {
            problems.push_back(
                {source, at + "/" + key, fmt::format("{} numbers", found), fmt::format("{} for a {}", numbers, b.shape), ""});
        }
    };
    if (b.shape == "box" || b.shape == "sheet") {
        wants("size", b.size.size(), b.shape == "box" ? 3 : 2);
    }
    if (b.shape != "file") {
        wants("cells", b.cells.size(), b.shape == "box" || b.shape == "cylinder" ? 3 : b.shape == "sphere" ? 1 : 2);
        double elements = 1.0;
        for (std::size_t k = 0; k < b.cells.size(); ++k) {
            elements *= b.shape == "sphere" ? 20.0 * std::pow(4.0, b.cells[k]) : b.cells[k];
            if (b.cells[k] != std::round(b.cells[k])) {
                problems.push_back({source, fmt::format("{}/cells/{}", at, k), fmt::format("{:.6g}", b.cells[k]), "a whole number", ""});
            }
        }
        constexpr double most = 5e6;
        if (elements > most) {
            problems.push_back(
                {source, at + "/cells", fmt::format("{:.3g} elements", elements), fmt::format("at most {:.3g}", most), "fewer cells"});
        }
    }
    for (std::size_t k = 0; k < b.holds.size(); ++k) {
        const std::string& axes = b.holds[k].axes;
        if (axes.empty() || axes.find_first_not_of("xyz") != std::string::npos) {
            problems.push_back(
                {source, fmt::format("{}/holds/{}/axes", at, k), "\"" + axes + "\"", "letters of xyz, such as \"z\" or \"xyz\"", ""});
        }
    }
}

} // namespace proveta
