// The calculation itself: spheres, clusters, bonds, contacts, walls and deformable bodies, stepped through time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/bonds/bond_forces.hpp"
#include "core/bonds/bonds.hpp"
#include "core/boundaries/pressure.hpp"
#include "core/boundaries/walls.hpp"
#include "core/contacts/contacts.hpp"
#include "core/energy/ledger.hpp"
#include "core/motion/cluster_motion.hpp"
#include "core/motion/impact_step.hpp"
#include "core/motion/mass_scaling.hpp"
#include "core/motion/motion.hpp"
#include "core/motion/stable_step.hpp"
#include "core/motion/travel.hpp"
#include "core/parallel/team.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// How the calculation is carried out.
struct Numerics {
    std::optional<double> time_step; ///< s; empty: safety times the stable step
    double safety = 0.9;             ///< fraction of the bound on the stable step
    double skin = 0.1;               ///< of the neighbour lists, over the mean radius
    double mass_scaling =
        0.0; ///< largest mass that may be added to spheres that limit the step, over the specimen's; as much again later on
    BackgroundDamping damping;
    Scheme scheme = Scheme::velocity_verlet;
    Vec3 gravity = Vec3::Zero();          ///< m/s2
    double fastest = 0.1;                 ///< mean radii that a sphere may go in a step; who is faster shows that the calculation diverged
    std::optional<double> overlap_growth; ///< by which overlaps are taken to grow until the next search, m; empty: the skin, their most
    double energy_made = 0.5;             ///< over what was put in: more that comes from nothing shows that the calculation diverged
    bool impacts = false;                 ///< loose contacts with the dashpots that impacts want (contact_law.hpp)
    double impact_steps = 0.0;            ///< that an impact without damping takes at least (impact_step.hpp); 0: only stability counts
    bool refuse_unstable = true;          ///< false only to study how a scheme diverges: a step above the stable one is kept
};

/// What `Model::step(true)` measured besides the ledger; values at the time of the last forces.
struct StepMeasures {
    double unbalanced_ratio = 0.0; ///< sum over spheres of |sum of forces| over the sum of |bond force|
};

/// Wall time spent so far in the phases of steps, s.
struct PhaseTimes {
    double search = 0.0;
    double forces = 0.0;
    double motion = 0.0;
};

/// The step that a user asked for is above the stable one.
struct UnstableStep : std::runtime_error {
    UnstableStep(double asked_step, double stable_step);
    double asked, stable; ///< s
};

/// The calculation lost its footing: a quantity stopped being a number, a sphere ran away, energy came from nothing. The message says when,
/// where, and the probable cause.
struct NumericalFailure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A specimen with its boundaries. Public members are the state; the class keeps the step in order.
class Model {
  public:
    /// Takes spheres (with the velocities they have at time 0, at rest or set afterwards), their materials and bonds. weight: area weights
    /// of `make_bonds`; clusters: those that the last spheres belong to. Throws UnstableStep.
    Model(Spheres spheres, std::vector<Material> materials, Bonds bonds, std::vector<double> weight, Walls walls, const Numerics& numerics,
          Clusters clusters = {});

    /// One step: search, forces, motion, time. speeds: velocity of each platen during the step, m/s; surfaces move as they are driven. With
    /// `measure` the ledger's stored and kinetic terms, the bonds' output arrays and the measures are brought up to date.
    void step(const std::vector<double>& speeds, bool measure);

    [[nodiscard]] double dt() const { return dt_; }             ///< s
    [[nodiscard]] double first_dt() const { return first_dt_; } ///< step at the start; `dt` is below it once new contacts ask for that, s
    /// Largest overlap so far of two spheres, or of a sphere and a wall, over the smaller radius; only without bonds.
    [[nodiscard]] double largest_overlap() const { return largest_overlap_; }
    [[nodiscard]] double stable_step() const { return stable_; }               ///< bound at the last search, s
    [[nodiscard]] double time() const { return time_; }                        ///< s
    [[nodiscard]] const MassScaling& mass_scaling() const { return scaling_; } ///< masses in `spheres` are the scaled ones
    [[nodiscard]] std::int64_t steps() const { return steps_; }
    [[nodiscard]] const Ledger& ledger() const { return ledger_; }
    [[nodiscard]] const StepMeasures& measures() const { return measures_; }
    [[nodiscard]] const std::vector<BondFailure>& failures() const { return failures_; } ///< of the last step, in bond order
    [[nodiscard]] std::size_t broken() const { return broken_; }
    [[nodiscard]] std::int64_t searches() const { return searches_; }
    [[nodiscard]] const PhaseTimes& phase_times() const { return phase_times_; }

    /// Number of threads of the steps to come; at first that of OpenMP. The results do not depend on it.
    void set_threads(int threads) { team_ = std::make_unique<Team>(threads); }

    /// Another set of spheres and clusters takes over between two steps: some are new, some are gone, the rest may be numbered in another
    /// order. origin: old number of each new sphere, -1: it is new; a cluster's spheres go together. Contacts that stay keep their
    /// history, and the ledger's `initial` takes the energy that comes and goes. Only without bonds, platens, pressures and scaled
    /// masses; throws std::logic_error otherwise.
    void repopulate(Spheres spheres, Clusters clusters, const std::vector<std::int32_t>& origin);

    /// Skin of the neighbour lists from the next search on, m; that search comes at the next step.
    void set_skin(double skin);
    [[nodiscard]] double skin() const { return skin_; } ///< m

    /// Puts the skins of deformable bodies where their nodes are now, rather than at the last forces.
    void follow_bodies();

    /// Hash (FNV-1a, 64 bits) of all that `visit_state` names: equal where the bits of two states are.
    [[nodiscard]] std::uint64_t state_hash() const;

    /// Calls visit(name, value) for everything that a later step depends on and that set-up does not give back: doubles, integers and
    /// vectors of them. Used to store and to restore.
    template <class Visit> void visit_state(Visit&& visit);

    /// Rebuilds what follows from the state, after `visit_state` has restored it.
    void restored();

    Spheres spheres;
    std::vector<Material> materials;
    Bonds bonds;
    Contacts contacts;
    Loads loads; ///< what is added between steps acts in the next one
    Clusters clusters;
    Walls walls;
    std::vector<Pressure> pressures; ///< set their values between steps

  private:
    // What the pairs of one block of spheres come to in a step.
    struct BlockSums {
        BondDissipation bonds;
        ContactEnergies contacts;
        std::vector<WallSums> walls; // platens, then surfaces
        std::vector<SkinSums> bodies;
        double pressure = 0.0; // work, J
        std::vector<BondFailure> failures;
    };

    void search();
    void keep_stable(bool first);
    void look_ahead();
    [[nodiscard]] double way_of_step() const;
    [[nodiscard]] double damping_share() const;
    void arrange();
    void average();
    void forces(double elapsed, bool measure);
    void block_forces(std::size_t block, const BondView& view, const ContactView& touching, double elapsed, bool measure);
    void fail_by_averaged_stress();
    void motion(const std::vector<double>& speeds, bool measure);
    double move_bodies(const std::vector<double>& speeds, bool measure);
    [[nodiscard]] double stable_step_of_bodies() const;
    [[nodiscard]] double energy_of_bodies() const;
    MotionSums move(bool measure);
    [[nodiscard]] double body_work() const;
    [[nodiscard]] double growth() const { return numerics_.overlap_growth.value_or(skin_); }
    void check() const;
    void check_places() const;

    std::vector<double> weight_;
    Numerics numerics_;
    StepBound bound_;
    MassScaling scaling_;
    double mean_radius_ = 0.0;
    double skin_ = 0.0;
    bool search_anew_ = true;
    double body_gone_ = 0.0; // work of gravity on spheres that are gone, J
    Travel travel_;          // since neighbours and platens were listed
    // Since a surface was listed: how far spheres have gone, and the surface itself, m.
    struct SurfaceTrack {
        Travel spheres;
        double way = 0.0;
    };
    std::vector<SurfaceTrack> tracks_;
    std::vector<Travel> body_tracks_; // of the spheres, since a body listed them
    double bodies_kinetic_ = 0.0;     // at the last forces, J
    double bodies_weighed_ = 0.0;     // work of gravity on them, J
    std::vector<double> platens_at_;
    double dt_ = 0.0;
    double first_dt_ = 0.0;
    double last_dt_ = 0.0; // by which positions have come to where they are, s
    double stable_ = 0.0;
    double time_ = 0.0;
    std::int64_t steps_ = 0;
    std::int64_t searches_ = 0;
    std::size_t broken_ = 0;
    double fastest_ = 0.0;
    double largest_overlap_ = 0.0;
    Ledger ledger_;
    StepMeasures measures_;
    bool averaged_ = false;      // some bonds fail by an averaged criterion
    std::vector<double> volume_; // tributary volumes, for such criteria
    std::vector<double> averaged_value_;
    std::vector<std::uint8_t> shear_governs_;
    std::vector<BondFailure> failures_;
    std::unique_ptr<Team> team_;
    PhaseTimes phase_times_;
    std::vector<BlockSums> block_sums_;
    std::vector<MotionSums> block_motion_;
    std::vector<Vec3> reactions_; // of the platens at the last forces, for the trapezoidal work
};

template <class Visit> void Model::visit_state(Visit&& visit) {
    auto field = [&](const std::string& name, VectorField& f) {
        visit(name + "_x", f.x);
        visit(name + "_y", f.y);
        visit(name + "_z", f.z);
    };
    field("position", spheres.position);
    field("velocity", spheres.velocity);
    field("spin", spheres.spin);
    if (!clusters.empty()) {
        clusters.visit_state(visit);
    }
    visit("mass", spheres.mass);
    visit("inertia", spheres.inertia);
    visit("mass_added_later", scaling_.added_later);
    field("searched_at", travel_.from);
    field("bond_slip", bonds.slip);
    for (std::size_t k = 0; k < bond_memory; ++k) {
        visit("bond_" + bonds.memory_name(k), bonds.memory[k]);
    }
    visit("bond_damage_work", bonds.damage_work);
    visit("bond_mode", bonds.mode);
    if (bonds.moments) {
        field("bond_rotation", bonds.rotation);
    }
    if (bonds.volumetric.active()) {
        visit("volumetric_strain", bonds.volumetric.strain);
    }
    if (bonds.dilatation.active()) {
        visit("bond_shift", bonds.dilatation.shift);
        visit("dilatation", bonds.dilatation.theta);
    }
    visit("contact_i", contacts.i);
    visit("contact_j", contacts.j);
    visit("contact_active", contacts.active); // who was apart and stays apart keeps even the signs of its zeros
    field("contact_slip", contacts.slip);
    field("contact_viscous", contacts.viscous);
    for (std::size_t p = 0; p < walls.platens.size(); ++p) {
        const std::string name = "platen_" + std::to_string(p) + "_";
        Platen& platen = walls.platens[p];
        visit(name + "position", platen.position);
        visit(name + "velocity", platen.velocity);
        visit(name + "searched_at", platens_at_[p]);
        visit(name + "sphere", platen.sphere);
        field(name + "slip", platen.slip);
        field(name + "viscous", platen.viscous);
        visit(name + "reaction_x", reactions_[p].x());
        visit(name + "reaction_y", reactions_[p].y());
        visit(name + "reaction_z", reactions_[p].z());
    }
    for (std::size_t p = 0; p < walls.surfaces.size(); ++p) {
        const std::string name = "surface_" + std::to_string(p) + "_";
        walls.surfaces[p].visit_state(name, visit);
        field(name + "searched_at", tracks_[p].spheres.from);
        visit(name + "travel", tracks_[p].spheres.bound);
        visit(name + "way", tracks_[p].way);
    }
    for (std::size_t p = 0; p < walls.bodies.size(); ++p) {
        const std::string name = "body_" + std::to_string(p) + "_";
        walls.bodies[p].visit_state(name, visit);
        field(name + "searched_at", body_tracks_[p].from);
        visit(name + "travel", body_tracks_[p].bound);
    }
    for (std::size_t p = 0; p < pressures.size(); ++p) {
        visit("pressure_" + std::to_string(p), pressures[p].value);
        field("pressure_" + std::to_string(p) + "_force", pressures[p].force);
    }
    visit("skin", skin_);
    std::int64_t anew = search_anew_ ? 1 : 0;
    visit("search_anew", anew);
    search_anew_ = anew != 0;
    visit("body_gone", body_gone_);
    visit("bodies_weighed", bodies_weighed_);
    visit("travel", travel_.bound);
    visit("dt", dt_);
    visit("first_dt", first_dt_);
    visit("last_dt", last_dt_);
    visit("stable", stable_);
    visit("time", time_);
    visit("steps", steps_);
    visit("searches", searches_);
    visit("fastest", fastest_);
    visit("largest_overlap", largest_overlap_);
    for (auto [name, value] : {std::pair{"platens", &ledger_.platens},
                               {"pressure", &ledger_.pressure},
                               {"body", &ledger_.body},
                               {"initial", &ledger_.initial},
                               {"coupling", &ledger_.coupling},
                               {"elastic", &ledger_.elastic},
                               {"kinetic", &ledger_.kinetic},
                               {"damage", &ledger_.damage},
                               {"plastic", &ledger_.plastic},
                               {"friction", &ledger_.friction},
                               {"dashpots", &ledger_.dashpots},
                               {"background", &ledger_.background}}) {
        visit(std::string("ledger_") + name, *value);
    }
}

} // namespace proveta
