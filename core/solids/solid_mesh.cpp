#include "core/solids/solid_mesh.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace proveta {

namespace {

// Outer faces of the elements, counter-clockwise seen from outside.
constexpr std::array<std::array<std::size_t, 3>, 4> tetrahedron_faces{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
constexpr std::array<std::array<std::size_t, 4>, 6> hexahedron_faces{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

// An element flatter than this, over its size, has neither volume nor area: nothing could be calculated with it.
constexpr double least_height = 1e-7;

template <class Element> bool in_range(const SolidMesh& mesh, const Element& element) {
    return std::all_of(element.begin(), element.end(), [&](std::uint32_t n) { return n < mesh.node.size(); });
}

template <class Element> bool repeats_a_node(Element element) {
    std::sort(element.begin(), element.end());
    return std::adjacent_find(element.begin(), element.end()) != element.end();
}

template <class Element> double longest_side(const SolidMesh& mesh, const Element& element) {
    double square = 0.0;
    for (std::size_t a = 0; a < element.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            square = std::max(square, (mesh.node[element[a]] - mesh.node[element[b]]).squaredNorm());
        }
    }
    return std::sqrt(square);
}

Vec3 twice_area(const SolidMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return (mesh.node[b] - mesh.node[a]).cross(mesh.node[c] - mesh.node[a]);
}

double volume(const SolidMesh& mesh, const SolidMesh::Tetrahedron& t) {
    return twice_area(mesh, t[0], t[1], t[2]).dot(mesh.node[t[3]] - mesh.node[t[0]]) / 6.0;
}

using Derivatives = std::array<Vec3, 8>; // of the eight shape functions by the three own coordinates
using Points = std::array<Derivatives, 8>;

// At the eight points of Gauss's rule of order two, +-1/sqrt(3); each weighs one. The determinant is of degree two in each coordinate, so
// that the rule's volume is exact.
Points hexahedron_points() {
    const std::array<Vec3, 8> corner{Vec3(-1, -1, -1), Vec3(1, -1, -1), Vec3(1, 1, -1), Vec3(-1, 1, -1),
                                     Vec3(-1, -1, 1),  Vec3(1, -1, 1),  Vec3(1, 1, 1),  Vec3(-1, 1, 1)};
    Points out;
    for (std::size_t q = 0; q < 8; ++q) {
        const Vec3 at = corner[q] / std::sqrt(3.0);
        for (std::size_t n = 0; n < 8; ++n) {
            const Vec3 f = Vec3::Ones() + corner[n].cwiseProduct(at);
            out[q][n] = 0.125 * corner[n].cwiseProduct(Vec3(f.y() * f.z(), f.z() * f.x(), f.x() * f.y()));
        }
    }
    return out;
}

// How the place in a hexahedron changes with its own three coordinates, column by column.
Mat3 jacobian(const SolidMesh& mesh, const SolidMesh::Hexahedron& h, const Derivatives& d) {
    Mat3 out = Mat3::Zero();
    for (std::size_t n = 0; n < 8; ++n) {
        out += mesh.node[h[n]] * d[n].transpose();
    }
    return out;
}

double volume(const SolidMesh& mesh, const SolidMesh::Hexahedron& h) {
    static const Points points = hexahedron_points();
    double sum = 0.0;
    for (const auto& point : points) {
        sum += jacobian(mesh, h, point).determinant();
    }
    return sum;
}

enum class Flaw { none, range, repeated, flat, inverted, folded };

Flaw shape_flaw(const SolidMesh& mesh, const SolidMesh::Tetrahedron& t) {
    double base = 0.0;
    for (const auto& face : tetrahedron_faces) {
        base = std::max(base, twice_area(mesh, t[face[0]], t[face[1]], t[face[2]]).norm());
    }
    const double v = 6.0 * volume(mesh, t);
    if (!(std::fabs(v) > least_height * base * longest_side(mesh, t))) { // the least height
        return Flaw::flat;
    }
    return v < 0.0 ? Flaw::inverted : Flaw::none;
}

Flaw shape_flaw(const SolidMesh& mesh, const SolidMesh::Hexahedron& h) {
    static const Points points = hexahedron_points();
    int right = 0;
    int turned = 0;
    for (const auto& point : points) {
        const Mat3 j = jacobian(mesh, h, point);
        const double share = j.determinant() / (j.col(0).norm() * j.col(1).norm() * j.col(2).norm());
        right += share > least_height ? 1 : 0;
        turned += share < -least_height ? 1 : 0;
    }
    if (right == 8) {
        return Flaw::none;
    }
    if (turned == 8) {
        return Flaw::inverted;
    }
    return right > 0 && turned > 0 ? Flaw::folded : Flaw::flat;
}

Flaw shape_flaw(const SolidMesh& mesh, const SolidMesh::Triangle& t) {
    const double side = longest_side(mesh, t);
    return twice_area(mesh, t[0], t[1], t[2]).norm() > least_height * side * side ? Flaw::none : Flaw::flat;
}

template <class Element> Flaw flaw_of(const SolidMesh& mesh, const Element& element) {
    if (!in_range(mesh, element)) {
        return Flaw::range;
    }
    return repeats_a_node(element) ? Flaw::repeated : shape_flaw(mesh, element);
}

std::string place(const Vec3& v) {
    return "(" + std::to_string(v.x()) + ", " + std::to_string(v.y()) + ", " + std::to_string(v.z()) + ") m";
}

// A kind of problem: how many have it, and the first of them.
struct Found {
    std::size_t count = 0;
    std::string first;

    void add(const std::string& which) {
        if (count++ == 0) {
            first = which;
        }
    }
    void tell(const std::string& what, std::vector<std::string>& out) const {
        if (count > 0) {
            out.push_back(first + " " + what + (count > 1 ? "; " + std::to_string(count) + " in all" : ""));
        }
    }
};

// What is wrong with the elements of one kind.
template <class Element>
void look_at(const SolidMesh& mesh, const std::vector<Element>& elements, const std::string& kind, std::vector<std::string>& out) {
    Found range;
    Found repeated;
    Found thin;
    Found inverted;
    Found folded;
    for (std::size_t k = 0; k < elements.size(); ++k) {
        const Flaw flaw = flaw_of(mesh, elements[k]);
        if (flaw == Flaw::none) {
            continue;
        }
        const std::string name = kind + " " + std::to_string(k + 1);
        const std::string where = flaw == Flaw::range ? name : name + " at " + place(mesh.node[elements[k][0]]);
        Found& found = flaw == Flaw::range      ? range
                       : flaw == Flaw::repeated ? repeated
                       : flaw == Flaw::flat     ? thin
                       : flaw == Flaw::inverted ? inverted
                                                : folded;
        found.add(where);
    }
    range.tell("has a node that is not there", out);
    repeated.tell("has the same node twice", out);
    thin.tell(std::tuple_size_v<Element> == 3 ? "has no area" : "has no volume", out);
    inverted.tell("is turned inside out", out);
    folded.tell("is folded over itself", out);
}

template <class Element> void mark(const std::vector<Element>& elements, std::vector<char>& used) {
    for (const auto& element : elements) {
        for (const std::uint32_t n : element) {
            if (n < used.size()) {
                used[n] = 1;
            }
        }
    }
}

std::vector<char> used_nodes(const SolidMesh& mesh) {
    std::vector<char> used(mesh.node.size(), 0);
    mark(mesh.tetrahedra, used);
    mark(mesh.hexahedra, used);
    mark(mesh.membranes, used);
    return used;
}

template <class Element> void renumber(std::vector<Element>& elements, const std::vector<std::uint32_t>& now) {
    for (auto& element : elements) {
        for (auto& n : element) {
            n = n < now.size() ? now[n] : n; // nodes that are not there stay so, for problems_of to find
        }
    }
}

void drop_unused(SolidMesh& mesh) {
    constexpr auto gone = std::numeric_limits<std::uint32_t>::max();
    const std::vector<char> used = used_nodes(mesh);
    std::vector<std::uint32_t> now(used.size(), gone);
    std::vector<Vec3> kept;
    for (std::size_t n = 0; n < used.size(); ++n) {
        if (used[n] != 0) {
            now[n] = static_cast<std::uint32_t>(kept.size());
            kept.push_back(mesh.node[n]);
        }
    }
    mesh.node = std::move(kept);
    renumber(mesh.tetrahedra, now);
    renumber(mesh.hexahedra, now);
    renumber(mesh.membranes, now);
    for (auto& group : mesh.groups) {
        std::vector<std::uint32_t> node;
        for (const std::uint32_t n : group.node) {
            if (n < now.size() && now[n] != gone) {
                node.push_back(now[n]);
            }
        }
        group.node = std::move(node);
    }
}

// A face as its element has it, and its nodes in ascending order to find its like by.
struct ElementSide {
    std::array<std::uint32_t, 4> key;
    std::size_t order;
    SkinFace face;
};

template <std::size_t corners, class Element>
void add_sides(const std::vector<Element>& elements, const std::array<std::array<std::size_t, corners>, 2 * corners - 2>& faces,
               std::vector<ElementSide>& out) {
    for (const auto& element : elements) {
        for (const auto& face : faces) {
            SkinFace skin{{element[face[0]], element[face[1]], element[face[2]], element[face[corners - 1]]}, corners == 4};
            auto key = skin.node;
            key[3] = corners == 4 ? key[3] : std::numeric_limits<std::uint32_t>::max();
            std::sort(key.begin(), key.end());
            out.push_back({key, out.size(), skin});
        }
    }
}

// Those with no like, in their order.
std::vector<SkinFace> single(std::vector<ElementSide> sides) {
    std::sort(sides.begin(), sides.end(),
              [](const ElementSide& a, const ElementSide& b) { return std::tie(a.key, a.order) < std::tie(b.key, b.order); });
    std::vector<ElementSide> alone;
    for (std::size_t k = 0; k < sides.size();) {
        std::size_t end = k + 1;
        while (end < sides.size() && sides[end].key == sides[k].key) {
            ++end;
        }
        if (end == k + 1) {
            alone.push_back(sides[k]);
        }
        k = end;
    }
    std::sort(alone.begin(), alone.end(), [](const ElementSide& a, const ElementSide& b) { return a.order < b.order; });
    std::vector<SkinFace> out;
    for (const auto& side : alone) {
        out.push_back(side.face);
    }
    return out;
}

} // namespace

std::vector<std::string> problems_of(const SolidMesh& mesh) {
    std::vector<std::string> out;
    if (mesh.elements() == 0) {
        out.emplace_back("no elements");
    }
    Found nowhere;
    Found unused;
    const std::vector<char> used = used_nodes(mesh);
    for (std::size_t n = 0; n < mesh.node.size(); ++n) {
        const std::string name = "node " + std::to_string(n + 1);
        if (!mesh.node[n].allFinite()) {
            nowhere.add(name);
        } else if (used[n] == 0) {
            unused.add(name + " at " + place(mesh.node[n]));
        }
    }
    nowhere.tell("has coordinates that are not finite", out);
    unused.tell("belongs to no element", out);
    look_at(mesh, mesh.tetrahedra, "tetrahedron", out);
    look_at(mesh, mesh.hexahedra, "hexahedron", out);
    look_at(mesh, mesh.membranes, "membrane triangle", out);
    for (const auto& group : mesh.groups) {
        if (!in_range(mesh, group.node)) {
            out.push_back("group " + group.name + " has a node that is not there");
        }
    }
    return out;
}

std::size_t tidy(SolidMesh& mesh) {
    drop_unused(mesh);
    std::size_t turned = 0;
    for (auto& t : mesh.tetrahedra) {
        if (in_range(mesh, t) && volume(mesh, t) < 0.0) {
            std::swap(t[1], t[2]);
            ++turned;
        }
    }
    for (auto& h : mesh.hexahedra) {
        if (in_range(mesh, h) && volume(mesh, h) < 0.0) {
            std::swap_ranges(h.begin(), h.begin() + 4, h.begin() + 4);
            ++turned;
        }
    }
    return turned;
}

std::vector<SkinFace> skin_of(const SolidMesh& mesh) {
    std::vector<ElementSide> sides;
    sides.reserve(4 * mesh.tetrahedra.size() + 6 * mesh.hexahedra.size());
    add_sides<3>(mesh.tetrahedra, tetrahedron_faces, sides);
    add_sides<4>(mesh.hexahedra, hexahedron_faces, sides);
    std::vector<SkinFace> out = single(std::move(sides));
    for (const auto& t : mesh.membranes) {
        out.push_back({{t[0], t[1], t[2], t[2]}, false});
    }
    return out;
}

double volume_of(const SolidMesh& mesh) {
    double sum = 0.0;
    for (const auto& t : mesh.tetrahedra) {
        sum += volume(mesh, t);
    }
    for (const auto& h : mesh.hexahedra) {
        sum += volume(mesh, h);
    }
    return sum;
}

} // namespace proveta
