// A deformable body among the spheres: its solid, its skin, and the forces that pass between skin and spheres (thesis 4.3, appendix B).
#pragma once

#include <string>
#include <vector>

#include "core/boundaries/near_faces.hpp"
#include "core/coupling/skin.hpp"
#include "core/motion/travel.hpp"
#include "core/solids/solid.hpp"

namespace proveta {

/// How a contact's force reaches the nodes.
enum class Coupling : std::uint8_t {
    area_distributed, ///< shared out over all faces that the sphere cuts, by their areas inside the circle of the cut (4.60-4.65, B)
    direct            ///< by the shape functions at the contact point of each contact (4.57)
};

/// A contact of one sphere with the skin, as of the last step.
struct SkinTouch {
    std::int32_t sphere;
    std::uint32_t triangle;
    Vec3 at; ///< barycentric coordinates of the contact point: it goes with the material
    WallHistory history;
    double stored = 0.0;       ///< energy of its springs, J
    Vec3 force = Vec3::Zero(); ///< on the sphere, N
    Vec3 point = Vec3::Zero(); ///< where it acts, m
};

/// Sums over contacts with a skin.
struct SkinSums : WallSums {
    double made = 0.0;       ///< energy that the distribution of forces put into the system in the step, negative where it took some out, J
    std::size_t crossed = 0; ///< contacts whose sphere's centre lies beyond the skin

    void add(const SkinSums& other) {
        WallSums::add(other);
        made += other.made;
        crossed += other.crossed;
    }
};

/// Force on a node, N.
struct NodeLoad {
    std::uint32_t node;
    Vec3 force;
};

struct Deformable : NearFaces {
    Solid solid;
    Skin skin;
    FaceTree tree;     ///< of the skin when spheres were last listed
    Material material; ///< of its surface, for contacts
    double friction = 0.0;
    Coupling coupling = Coupling::area_distributed;
    double side = 0.0; ///< on which spheres are, against the skin's normals: +1 outside, -1 inside, 0 both. On one side a sphere whose
                       ///< centre has crossed is pushed back, and counted

    std::vector<LooseContact> law;               ///< per listed sphere
    std::vector<std::vector<SkinTouch>> touches; ///< per block of spheres, ascending by sphere
    std::vector<std::vector<NodeLoad>> loads;    ///< per block of spheres
    std::vector<Vec3> listed_at;                 ///< nodes when spheres were last listed, m
    SkinSums sums;                               ///< of the last step
    std::int64_t crossings = 0;                  ///< contacts beyond the skin, over all steps

    Deformable() = default;
    Deformable(Solid body, const Material& surface, double friction_coefficient, Coupling how, double on_side);

    /// Longest way of a node since spheres were listed, m.
    [[nodiscard]] double way() const;
    /// As `Surface::renumber`.
    double renumber(const std::vector<std::int32_t>& now, std::size_t spheres);

    /// As `Model::visit_state`.
    template <class Visit> void visit_state(const std::string& prefix, Visit&& visit) {
        solid.visit_state(prefix, visit);
        Flat flat = flattened();
        visit(prefix + "lists", flat.lists);
        visit(prefix + "touches", flat.touches);
        visit(prefix + "values", flat.values);
        visit(prefix + "crossings", crossings);
        restore(flat);
    }

  private:
    struct Flat {
        std::vector<std::int32_t> lists;   // number of listed spheres, these, where their faces begin, their faces
        std::vector<std::int32_t> touches; // sphere and triangle of each
        std::vector<double> values;        // nodes when listed; of each touch: coordinates, slip, dashpots' force, energy
    };
    [[nodiscard]] Flat flattened() const;
    void restore(const Flat& flat);
};

/// Lists anew the spheres within `skin` metres of touching, and the faces near each. Contacts stay as they are.
void search_deformable(const Spheres& spheres, const std::vector<Material>& materials, double skin, Deformable& body, Team& team);

/// Fills in the constants of the listed spheres' contacts.
void set_up_deformable(const Spheres& spheres, const std::vector<Material>& materials, Deformable& body);

/// Finds the contacts of one block of spheres with the skin as it is, advances them, adds their forces to the spheres' loads and keeps
/// those on the nodes. Every sphere's forces and torques are balanced on the nodes to round-off.
SkinSums deformable_forces(const Spheres& spheres, Deformable& body, std::size_t number, const SphereBlock& block, const ContactStep& step,
                           Loads& loads);

/// Adds what the blocks kept to the nodes, block after block.
void collect_node_loads(Deformable& body);

/// Factor on a contact's stiffness in the stable step's bound on the sphere, the rest being asked of the nodes.
double sphere_share(const Deformable& body, double sphere_mass);

/// Largest stable step of the nodes, with elements and every contact that there may be before the next search, s. growth: of overlaps
/// until then, m; skin: how far spheres may go until then, m.
double stable_step(const Deformable& body, const Spheres& spheres, double growth, double skin);

} // namespace proveta
