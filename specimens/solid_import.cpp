#include "specimens/solid_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <stdexcept>

#include "core/input/text_file.hpp"
#include "core/input/words.hpp"
#include "specimens/memory.hpp"
#include "specimens/solid_content.hpp"

namespace proveta {

namespace solid_files {

std::size_t nodes_of(Kind kind) {
    constexpr std::array<std::size_t, 6> count{1, 2, 3, 4, 4, 8};
    return count[static_cast<std::size_t>(kind)];
}

int dimension_of(Kind kind) {
    constexpr std::array<int, 6> dimension{0, 1, 2, 2, 3, 3};
    return dimension[static_cast<std::size_t>(kind)];
}

std::string bytes_of(const std::string& file) {
    require_file(file);
    return input::read_text(file, largest_file);
}

std::string text_of(const std::string& file) { return input::as_utf8(bytes_of(file), file); }

} // namespace solid_files

namespace {

using namespace solid_files;

// Elements of the same nodes as one before go: Gmsh writes an element once for each of its groups.
std::size_t drop_repeated(std::vector<Element>& elements) {
    struct Key {
        std::array<std::uint32_t, 8> node;
        std::size_t at;
    };
    std::vector<Key> keys;
    for (std::size_t k = 0; k < elements.size(); ++k) {
        if (dimension_of(elements[k].kind) > 1) {
            keys.push_back({elements[k].node, k});
            std::sort(keys.back().node.begin(), keys.back().node.end());
        }
    }
    std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) { return std::tie(a.node, a.at) < std::tie(b.node, b.at); });
    std::vector<char> gone(elements.size(), 0);
    for (std::size_t k = 1; k < keys.size(); ++k) {
        // A quadrilateral and a tetrahedron may have the same nodes.
        if (keys[k].node == keys[k - 1].node && elements[keys[k].at].kind == elements[keys[k - 1].at].kind) {
            gone[keys[k].at] = 1;
        }
    }
    std::size_t at = 0;
    return std::erase_if(elements, [&](const Element&) { return gone[at++] != 0; });
}

// Cut along the shorter diagonal, unless the halves contradict each other then, as where a corner points inwards.
void add_quadrilateral(SolidMesh& mesh, const std::array<std::uint32_t, 8>& q) {
    const auto x = [&](std::size_t k) -> const Vec3& { return mesh.node[q[k]]; };
    const auto agree = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
        return (x(b) - x(a)).cross(x(c) - x(a)).dot((x(c) - x(a)).cross(x(d) - x(a))) > 0.0;
    };
    const double first = (x(2) - x(0)).norm();
    const double second = (x(3) - x(1)).norm();
    bool other = second < (1.0 - 1e-9) * first; // of equal ones always the same, whatever the last bits say
    if (other ? !agree(1, 2, 3, 0) && agree(0, 1, 2, 3) : !agree(0, 1, 2, 3) && agree(1, 2, 3, 0)) {
        other = !other;
    }
    if (other) {
        mesh.membranes.push_back({q[0], q[1], q[3]});
        mesh.membranes.push_back({q[1], q[2], q[3]});
    } else {
        mesh.membranes.push_back({q[0], q[1], q[2]});
        mesh.membranes.push_back({q[0], q[2], q[3]});
    }
}

// Elements of the mesh from those of the file. Returns how many make no element and name no group.
std::size_t add_elements(const std::vector<Element>& elements, SolidMesh& mesh) {
    const bool body = std::any_of(elements.begin(), elements.end(), [](const Element& e) { return dimension_of(e.kind) == 3; });
    std::size_t idle = 0;
    for (const auto& [kind, grouped, n, tag, place] : elements) {
        if (kind == Kind::tetrahedron) {
            mesh.tetrahedra.push_back({n[0], n[1], n[2], n[3]});
        } else if (kind == Kind::hexahedron) {
            mesh.hexahedra.push_back(n);
        } else if (kind == Kind::triangle && !body) {
            mesh.membranes.push_back({n[0], n[1], n[2]});
        } else if (kind == Kind::quadrilateral && !body) {
            add_quadrilateral(mesh, n);
        } else {
            idle += grouped ? 0 : 1;
        }
    }
    return idle;
}

// Names of the groups. Gmsh counts groups of each dimension by themselves, so that two may be called the same: those say what they are of.
std::map<Content::Name, std::string> names_of(const Content& content) {
    constexpr std::array<const char*, 4> of{"points", "lines", "surfaces", "volumes"};
    std::map<Content::Name, std::string> out;
    std::map<std::string, std::array<bool, 4>> seen;
    for (const auto& [key, nodes] : content.group) {
        const auto named = content.name.find(key);
        out[key] = named == content.name.end() || named->second.empty() ? std::to_string(key.second) : named->second;
        seen[out[key]][static_cast<std::size_t>(key.first)] = true;
    }
    for (auto& [key, name] : out) {
        const auto& dimensions = seen[name];
        if (std::count(dimensions.begin(), dimensions.end(), true) > 1) {
            name += fmt::format(" ({})", of[static_cast<std::size_t>(key.first)]);
        }
    }
    return out;
}

void add_groups(const Content& content, SolidMesh& mesh) {
    for (const auto& [key, name] : names_of(content)) {
        const auto same = [&name = name](const SolidMesh::Group& g) { return g.name == name; };
        auto at = std::find_if(mesh.groups.begin(), mesh.groups.end(), same);
        if (at == mesh.groups.end()) {
            at = mesh.groups.insert(at, {name, {}});
        }
        const auto& nodes = content.group.at(key);
        at->node.insert(at->node.end(), nodes.begin(), nodes.end());
    }
    for (auto& group : mesh.groups) {
        std::sort(group.node.begin(), group.node.end());
        group.node.erase(std::unique(group.node.begin(), group.node.end()), group.node.end());
    }
}

std::size_t nodes_in_one_place(const SolidMesh& mesh) {
    std::vector<std::array<double, 3>> x;
    for (const auto& v : mesh.node) {
        x.push_back({v.x(), v.y(), v.z()});
    }
    std::sort(x.begin(), x.end());
    return x.size() - static_cast<std::size_t>(std::unique(x.begin(), x.end()) - x.begin());
}

Content read(const std::string& file) {
    require_file(file);
    const std::string type = input::lower_case(std::filesystem::path(file).extension().string());
    if (type == ".msh") {
        return read_gmsh(file);
    }
    if (type == ".vtk" || type == ".vtu") {
        return read_vtk(file, type == ".vtk");
    }
    throw std::runtime_error(file + ": meshes of bodies are read from .msh, .vtk and .vtu files");
}

void refuse_problems(const SolidMesh& mesh, const std::string& file) {
    const auto problems = problems_of(mesh);
    if (!problems.empty()) {
        throw std::runtime_error(fmt::format("{}: {}", file, fmt::join(problems, "; ")));
    }
}

// Leaves out what has no use, turns what is inverted and says so.
void mend(ImportedSolid& out) {
    const auto note = [&](std::size_t count, const std::string& what) {
        if (count > 0) {
            out.notes.push_back(fmt::format("{} {}", count, what));
        }
    };
    const std::size_t nodes = out.mesh.node.size();
    const std::size_t turned = tidy(out.mesh);
    note(nodes - out.mesh.node.size(), "nodes of no element were left out");
    note(turned, "inverted elements were turned");
    note(nodes_in_one_place(out.mesh), "nodes lie where another does; what they belong to is not joined there");
    std::erase_if(out.mesh.groups, [&](const SolidMesh::Group& group) {
        if (group.node.empty()) {
            out.notes.push_back(fmt::format("group {} has no node of the mesh and was left out", group.name));
        }
        return group.node.empty();
    });
}

} // namespace

ImportedSolid import_solid(const std::string& file, double scale) {
    if (!(scale > 0.0) || !std::isfinite(scale)) {
        throw std::runtime_error(fmt::format("{}: scale {} is not positive", file, scale));
    }
    Content content = read(file);
    ImportedSolid out;
    out.notes = std::move(content.notes);
    const std::size_t repeated = drop_repeated(content.elements);
    if (repeated > 0) {
        out.notes.push_back(fmt::format("{} elements are in the file more than once and were taken once", repeated));
    }
    for (const auto& v : content.node) {
        out.mesh.node.emplace_back(scale * v);
    }
    const std::size_t idle = add_elements(content.elements, out.mesh);
    if (out.mesh.elements() == 0) {
        throw std::runtime_error(file + ": holds no tetrahedra, hexahedra, triangles or quadrilaterals");
    }
    if (idle > 0) {
        out.notes.push_back(fmt::format("{} points, lines, triangles and quadrilaterals that are of no group were left out", idle));
    }
    add_groups(content, out.mesh);
    mend(out);
    refuse_problems(out.mesh, file);
    return out;
}

} // namespace proveta
