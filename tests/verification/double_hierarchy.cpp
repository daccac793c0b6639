// The Double Hierarchy method in a million random situations, against the thesis's tables carried out word for word on every face and
// against the nearest point of convex bodies.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "core/boundaries/double_hierarchy.hpp"
#include "core/boundaries/face_tree.hpp"
#include "core/boundaries/surface_shapes.hpp"
#include "tests/bodies.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

using Points = std::vector<Vec3>;

// Table 3.4 for a new contact point, as printed but for the tolerance that makes coplanar neighbours one: between faces. Within a face
// rounding alone counts: the end of an edge lies exactly on the tangent plane of a contact with that edge.
void distance_hierarchy(Points& valid, const Vec3& found, const Vec3& centre, double tolerance) {
    const Vec3 v_i = centre - found;
    for (std::size_t j = 0; j < valid.size();) {
        const Vec3 v_j = centre - valid[j];
        if (v_i.dot(v_j) / v_j.norm() >= v_j.norm() * (1.0 - tolerance)) {
            return;
        }
        if (v_j.dot(v_i) / v_i.norm() >= v_i.norm() * (1.0 - tolerance)) {
            valid.erase(valid.begin() + static_cast<std::ptrdiff_t>(j));
        } else {
            ++j;
        }
    }
    valid.push_back(found);
}

// Table 3.3 for one face, every contact point handed to table 3.4.
Points contact_type_hierarchy(const SurfaceMesh& mesh, std::size_t f, const Vec3& centre, double radius) {
    Points valid;
    const std::size_t n = mesh.corners(f);
    const Vec3 normal = mesh.twice_area(f).normalized();
    const double height = normal.dot(centre - mesh.at(f, 0));
    if (std::fabs(height) > radius) {
        return valid;
    }
    const Vec3 projection = centre - height * normal;
    std::size_t outside = n;
    for (std::size_t a = 0; a < n && outside == n; ++a) {
        if ((mesh.at(f, (a + 1) % n) - mesh.at(f, a)).cross(projection - mesh.at(f, a)).dot(normal) < 0.0) {
            outside = a;
        }
    }
    if (outside == n) {
        return {projection};
    }
    for (std::size_t a = outside; a < n; ++a) {
        const Vec3 from = mesh.at(f, a);
        const Vec3 edge = mesh.at(f, (a + 1) % n) - from;
        const double along = (centre - from).dot(edge.normalized());
        const Vec3 foot = from + along * edge.normalized();
        if ((foot - centre).norm() > radius) {
            continue;
        }
        const double eta = along / edge.norm();
        const Vec3 vertex = eta < 0.0 ? from : Vec3(from + edge);
        if (eta >= 0.0 && eta <= 1.0) {
            distance_hierarchy(valid, foot, centre, 1e-12);
        } else if ((vertex - centre).norm() <= radius) {
            distance_hierarchy(valid, vertex, centre, 1e-12);
        }
    }
    return valid;
}

// Both tables on all faces without any search; the faces' contacts come to table 3.4 in the order of their distance, or as they are
// numbered.
Points by_the_tables(const SurfaceMesh& mesh, const Vec3& centre, double radius, bool by_distance) {
    Points all;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        for (const auto& p : contact_type_hierarchy(mesh, f, centre, radius)) {
            all.push_back(p);
        }
    }
    if (by_distance) {
        std::stable_sort(all.begin(), all.end(), [&](const Vec3& a, const Vec3& b) { return (a - centre).norm() < (b - centre).norm(); });
    }
    Points valid;
    for (const auto& p : all) {
        distance_hierarchy(valid, p, centre, coplanar);
    }
    return valid;
}

bool same_points(const Points& a, const std::vector<FaceContact>& b, double tolerance) {
    if (a.size() != b.size()) {
        return false;
    }
    return std::all_of(b.begin(), b.end(), [&](const FaceContact& c) {
        return std::any_of(a.begin(), a.end(), [&](const Vec3& p) { return (p - c.point).norm() <= tolerance; });
    });
}

// Ericson's closest point on a triangle, by the regions of its plane (Real-Time Collision Detection, 5.1.5).
Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0 && d2 <= 0) {
        return a;
    }
    const Vec3 bp = p - b;
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0 && d4 <= d3) {
        return b;
    }
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        return a + d1 / (d1 - d3) * ab;
    }
    const Vec3 cp = p - c;
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0 && d5 <= d6) {
        return c;
    }
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        return a + d2 / (d2 - d6) * ac;
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        return b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b);
    }
    return a + vb / (va + vb + vc) * ab + vc / (va + vb + vc) * ac;
}

// A landscape of triangles, convex and concave, in the same size as the spheres to much smaller.
SurfaceMesh landscape(Dice& dice, int n) {
    SurfaceMesh mesh;
    const double rough = dice(0.0, 0.8) / n;
    for (int y = 0; y <= n; ++y) {
        for (int x = 0; x <= n; ++x) {
            mesh.vertex.emplace_back(x / static_cast<double>(n) - 0.5, y / static_cast<double>(n) - 0.5, dice(-rough, rough));
        }
    }
    const auto row = static_cast<std::uint32_t>(n + 1);
    for (std::uint32_t y = 0; y + 1 < row; ++y) {
        for (std::uint32_t x = 0; x + 1 < row; ++x) {
            const std::uint32_t a = y * row + x;
            mesh.add({a, a + 1, a + row + 1});
            mesh.add({a, a + row + 1, a + row});
        }
    }
    return mesh;
}

void turn(SurfaceMesh& mesh, const Eigen::Quaterniond& q, const Vec3& stretch) {
    for (auto& v : mesh.vertex) {
        v = q * v.cwiseProduct(stretch);
    }
}

struct Situation {
    Vec3 centre;
    double radius;
};

// A sphere that touches, or nearly touches, some face.
Situation near_some_face(Dice& dice, const SurfaceMesh& mesh) {
    const auto f = static_cast<std::size_t>(dice(0, static_cast<double>(mesh.faces())));
    const double side = (mesh.at(f, 1) - mesh.at(f, 0)).norm();
    Vec3 at = Vec3::Zero();
    double sum = 0.0;
    for (std::size_t k = 0; k < mesh.corners(f); ++k) {
        const double w = dice(0, 1);
        at += w * mesh.at(f, k);
        sum += w;
    }
    const double radius = side * std::exp(dice(std::log(0.05), std::log(10.0)));
    return {at / sum + dice.in_box(1.0) * radius, radius};
}

struct Count {
    std::size_t situations = 0, touching = 0, several = 0, wrong = 0, order_matters = 0;
};

void compare(const SurfaceMesh& mesh, Dice& dice, int situations, Count& count) {
    const SurfaceGeometry geometry{SurfaceMesh(mesh)};
    const FaceTree tree(mesh);
    std::vector<std::uint32_t> near;
    std::vector<FaceContact> found;
    for (int k = 0; k < situations; ++k) {
        const auto [centre, radius] = near_some_face(dice, mesh);
        near.clear();
        tree.near(centre, radius, near);
        double_hierarchy(geometry, near, centre, radius, found);
        const Points known = by_the_tables(mesh, centre, radius, true);
        ++count.situations;
        count.touching += found.empty() ? 0 : 1;
        count.several += found.size() > 1 ? 1 : 0;
        count.wrong += same_points(known, found, 1e-9 * radius) ? 0 : 1;
        count.order_matters += same_points(by_the_tables(mesh, centre, radius, false), found, 1e-9 * radius) ? 0 : 1;
    }
}

} // namespace

TEST_CASE("double-hierarchy: contacts are those of the tables on every face") {
    Dice dice(1);
    Count count;
    for (int world = 0; world < 1000; ++world) {
        SurfaceMesh mesh;
        switch (world % 5) {
        case 0: mesh = landscape(dice, 4); break;
        case 1: // faces without order that cut each other
            for (std::uint32_t k = 0; k < 12; ++k) {
                for (int c = 0; c < 3; ++c) {
                    mesh.vertex.push_back(dice.in_box(0.5));
                }
                mesh.add({3 * k, 3 * k + 1, 3 * k + 2});
            }
            break;
        case 2:
            mesh = cylinder_surface(0.3, 0.2, 0.4, 7, true, true); // seven corners, quadrilaterals
            break;
        case 3: mesh = refined(box_surface({1.0, 0.7, 0.4})); break;
        default: mesh = helix_surface(0.1, 0.4, 0.3, 0.6, 8, 2);
        }
        turn(mesh, dice.attitude(), Vec3(dice(0.5, 2.0), 1.0, 1.0));
        compare(mesh, dice, 500, count);
    }
    INFO("touching " << count.touching << ", at several points " << count.several << ", where the tables' own order of faces matters "
                     << count.order_matters);
    CHECK(count.situations == 500000);
    CHECK(count.touching > 200000);
    CHECK(count.several > 50000);
    CHECK(count.wrong == 0);
    // As printed, table 3.4 may throw out a contact for one that is then thrown out itself.
    CHECK(count.order_matters > 0);
}

TEST_CASE("double-hierarchy: outside a convex body the contact is its nearest point") {
    Dice dice(2);
    std::size_t situations = 0, touching = 0, wrong = 0;
    for (int world = 0; world < 1000; ++world) {
        SurfaceMesh mesh = world % 4 == 0   ? box_surface({1.0, 0.6, 0.3})
                           : world % 4 == 1 ? refined(refined(box_surface({0.5, 0.5, 0.5})))
                           : world % 4 == 2 ? sphere_surface(0.5, 1)
                                            : cylinder_surface(0.4, 0.0, 0.5, 11, true, true);
        turn(mesh, dice.attitude(), Vec3(dice(0.3, 3.0), dice(0.3, 3.0), 1.0));
        const SurfaceGeometry geometry{SurfaceMesh(mesh)};
        const FaceTree tree(mesh);
        const SurfaceMesh triangles = triangulated(mesh);
        std::vector<std::uint32_t> near;
        std::vector<FaceContact> found;
        for (int k = 0; k < 500;) {
            const auto [centre, radius] = near_some_face(dice, mesh);
            const auto inside = [&, c = centre](const FacePlane& p) { return p.normal.dot(c) <= p.offset; };
            if (std::all_of(geometry.plane.begin(), geometry.plane.end(), inside)) {
                continue;
            }
            ++k;
            near.clear();
            tree.near(centre, radius, near);
            double_hierarchy(geometry, near, centre, radius, found);
            Vec3 nearest = Vec3::Constant(1e300);
            for (std::size_t f = 0; f < triangles.faces(); ++f) {
                const Vec3 p = nearest_on_triangle(centre, triangles.at(f, 0), triangles.at(f, 1), triangles.at(f, 2));
                nearest = (p - centre).norm() < (nearest - centre).norm() ? p : nearest;
            }
            const double distance = (nearest - centre).norm();
            ++situations;
            touching += found.empty() ? 0 : 1;
            const bool right = distance <= radius ? found.size() == 1 && (found[0].point - nearest).norm() <= 1e-7 * radius : found.empty();
            wrong += right || std::fabs(distance - radius) < 1e-12 * radius ? 0 : 1;
        }
    }
    CHECK(situations == 500000);
    CHECK(touching > 200000);
    CHECK(wrong == 0);
}

TEST_CASE("double-hierarchy: a mesh turned, moved and renumbered gives the same contacts") {
    Dice dice(3);
    std::size_t wrong = 0, several = 0;
    for (int world = 0; world < 200; ++world) {
        const SurfaceMesh mesh = landscape(dice, 4);
        const Eigen::Quaterniond q = dice.attitude();
        const Vec3 shift = dice.in_box(1.0);
        SurfaceMesh other;
        std::vector<std::size_t> order(mesh.faces());
        for (std::size_t k = 0; k < order.size(); ++k) {
            order[k] = k * 7 % order.size(); // 32 faces
        }
        for (const auto& v : mesh.vertex) {
            other.vertex.insert(other.vertex.begin(), q * v + shift);
        }
        for (const auto f : order) {
            std::vector<std::uint32_t> face;
            for (std::size_t k = 0; k < 3; ++k) { // begins at another corner
                face.push_back(static_cast<std::uint32_t>(mesh.vertex.size() - 1) - mesh.corner[mesh.first[f] + (k + 1) % 3]);
            }
            other.add(face);
        }
        const SurfaceGeometry a{SurfaceMesh(mesh)};
        const SurfaceGeometry b{SurfaceMesh(other)};
        std::vector<std::uint32_t> all(mesh.faces());
        for (std::uint32_t k = 0; k < all.size(); ++k) {
            all[k] = k;
        }
        std::vector<FaceContact> in_a, in_b;
        for (int k = 0; k < 500; ++k) {
            const auto [centre, radius] = near_some_face(dice, mesh);
            double_hierarchy(a, all, centre, radius, in_a);
            double_hierarchy(b, all, q * centre + shift, radius, in_b);
            Points known;
            for (const auto& c : in_a) {
                known.push_back(q * c.point + shift);
            }
            several += in_a.size() > 1 ? 1 : 0;
            wrong += same_points(known, in_b, 1e-9) ? 0 : 1;
        }
    }
    CHECK(several > 10000);
    CHECK(wrong == 0);
}

TEST_CASE("double-hierarchy: weights of the corners are positive, sum to one and give the point") {
    Dice dice(4);
    for (const auto& mesh : {landscape(dice, 3), cylinder_surface(0.3, 0.2, 0.4, 7, true, true), box_surface({1, 2, 3})}) {
        const SurfaceGeometry geometry{SurfaceMesh(mesh)};
        for (int k = 0; k < 2000; ++k) {
            const auto [centre, radius] = near_some_face(dice, mesh);
            const auto f = static_cast<std::uint32_t>(dice(0, static_cast<double>(mesh.faces())));
            const FaceContact contact = nearest_on_face(geometry, f, centre);
            const auto w = contact_weights(geometry, contact);
            Vec3 point = Vec3::Zero();
            double sum = 0.0;
            for (std::size_t c = 0; c < w.size(); ++c) {
                CHECK(w[c] >= -1e-12);
                sum += w[c];
                point += w[c] * mesh.at(f, c);
            }
            CHECK(sum == Approx(1.0).epsilon(1e-12));
            CHECK((point - contact.point).norm() < 1e-12);
        }
    }
}
