#include "core/model.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <sstream>

#include "core/averaged_stress.hpp"
#include "core/hash.hpp"

namespace proveta {

namespace {

template <class... Parts> std::string text(const Parts&... parts) {
    std::ostringstream out;
    out.precision(4);
    (out << ... << parts);
    return out.str();
}

// Share of the stable step that non-viscous damping leaves. Its force may point along the spring force and is alpha times as large, so that
// in the fastest mode it acts like springs stiffened by 1 + alpha.
double damping_share(const BackgroundDamping& damping) {
    return damping.viscous ? 1.0 : 1.0 / std::sqrt(1.0 + std::max(damping.translation, damping.rotation));
}

} // namespace

UnstableStep::UnstableStep(double asked_step, double stable_step)
    : std::runtime_error(text("the time step of ", asked_step, " s is above the stable one of ", stable_step, " s")), asked(asked_step),
      stable(stable_step) {}

Model::Model(Spheres s, std::vector<Material> m, Bonds b, std::vector<double> weight, Walls rigid, const Numerics& numerics,
             Clusters bodies)
    : spheres(std::move(s)), materials(std::move(m)), bonds(std::move(b)), clusters(std::move(bodies)), walls(std::move(rigid)),
      weight_(std::move(weight)), numerics_(numerics), bound_(spheres, bonds), team_(std::make_unique<Team>(omp_get_max_threads())) {
    mean_radius_ = mean_radius(spheres);
    skin_ = numerics_.skin * mean_radius_;
    reactions_.assign(walls.platens.size(), Vec3::Zero());
    averaged_ = std::any_of(bonds.laws.begin(), bonds.laws.end(), [](const BondLaw& law) { return law.criterion != Criterion::bond; });
    if (averaged_) {
        volume_ = tributary_volumes(spheres, bonds);
    }
    loads = Loads(spheres.size());
    block_sums_.resize(loads.blocks().size());
    block_motion_.resize(loads.blocks().size());
    search();
    const bool short_step = numerics_.time_step && *numerics_.time_step <= stable_; // asked for, and stable with true masses
    scaling_ = scale_masses(spheres, bonds, materials, weight_, contacts, walls, clusters, growth(),
                            short_step || !clusters.empty() ? 0.0 : numerics_.mass_scaling, bound_);
    scaling_.step_before *= damping_share(numerics_.damping);
    scaling_.step_after *= damping_share(numerics_.damping);
    stable_ = std::min(scaling_.step_after, stable_step_of_bodies());
    dt_ = numerics_.safety * stable_;
    if (numerics_.time_step) {
        dt_ = *numerics_.time_step;
        if (dt_ > stable_ && numerics_.refuse_unstable) {
            throw UnstableStep(dt_, stable_);
        }
    }
    first_dt_ = dt_;
}

void Model::step(const std::vector<double>& speeds, bool measure) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    search();
    const auto searched = Clock::now();
    // The first forces are those of the start: velocities count, but nothing has moved yet.
    const bool first = steps_ == 0;
    if (!scaling_.mass.empty() && !numerics_.gravity.isZero()) { // the mass added for the step's sake weighs nothing
        for (std::size_t k = 0; k < spheres.size(); ++k) {
            loads.add(k, (scaling_.mass[k] - spheres.mass[k]) * numerics_.gravity, Vec3::Zero());
        }
    }
    // A search may have shortened the step: what moved did so during the last one.
    forces(first ? 1e-9 * dt_ : last_dt_, measure || first);
    const auto loaded = Clock::now();
    motion(speeds, measure);
    const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
    phase_times_.search += seconds(searched - begin);
    phase_times_.forces += seconds(loaded - searched);
    phase_times_.motion += seconds(Clock::now() - loaded);
    time_ += dt_;
    last_dt_ = dt_;
    ++steps_;
}

// Lists neighbours anew once two spheres, or a sphere and a wall, may have come nearer by more than the skin. Surfaces may be faster than
// any sphere and are listed by themselves.
void Model::search() {
    const bool first = searches_ == 0;
    double platens_way = 0.0;
    for (std::size_t p = 0; p < platens_at_.size(); ++p) {
        platens_way = std::max(platens_way, std::fabs(walls.platens[p].position - platens_at_[p]));
    }
    const bool neighbours = search_anew_ || 2.0 * platens_way > skin_ || travel_.beyond(0.5 * skin_, spheres.position);
    if (neighbours) {
        contacts = search_contacts(spheres, bonds, clusters, materials, weight_, skin_, contacts, team_.get());
        platens_at_.resize(walls.platens.size());
        for (std::size_t p = 0; p < walls.platens.size(); ++p) {
            search_platen(spheres, materials, skin_, walls.platens[p]);
            platens_at_[p] = walls.platens[p].position;
        }
        arrange();
        travel_.restart(spheres.position);
        ++searches_;
    }
    bool surfaces = false;
    tracks_.resize(walls.surfaces.size());
    for (std::size_t p = 0; p < tracks_.size(); ++p) {
        SurfaceTrack& track = tracks_[p];
        if (search_anew_ || track.way > skin_ || track.spheres.beyond(skin_ - track.way, spheres.position)) {
            search_surface(spheres, materials, skin_, walls.surfaces[p], team_.get());
            track.spheres.restart(spheres.position);
            track.way = 0.0;
            surfaces = true;
        }
    }
    body_tracks_.resize(walls.bodies.size());
    for (std::size_t p = 0; p < body_tracks_.size(); ++p) {
        Deformable& body = walls.bodies[p];
        if (const double way = body.way(); search_anew_ || way > skin_ || body_tracks_[p].beyond(skin_ - way, spheres.position)) {
            search_deformable(spheres, materials, skin_, body, *team_);
            body_tracks_[p].restart(spheres.position);
            surfaces = true;
        }
    }
    search_anew_ = false;
    if (neighbours || surfaces) {
        follow_bodies(); // the bound looks at the skin as it is now
        keep_stable(first);
    }
}

// What was stable stays the bound, unless new contacts have made the network too stiff for the step. Then the spheres that they press on
// get more mass, as far as that is allowed, and only beyond that the step is shortened.
void Model::keep_stable(bool first) {
    const double share = damping_share(numerics_.damping);
    if (first) {
        stable_ = std::min(share * bound_.limit({spheres, bonds, contacts, walls, clusters}, growth()), stable_step_of_bodies());
        return;
    }
    if (!numerics_.refuse_unstable) {
        return; // the step stays as it is
    }
    const double bodies = stable_step_of_bodies();
    const double lowest = std::min(share * bound_.limit({spheres, bonds, contacts, walls, clusters}, growth(), dt_ / share), bodies);
    if (lowest >= dt_) {
        return;
    }
    stable_ = lowest;
    if (!scaling_.mass.empty()) {
        const double whole = std::accumulate(scaling_.mass.begin(), scaling_.mass.end(), 0.0);
        const double left = (numerics_.mass_scaling - scaling_.added_later) * whole;
        const double wanted = dt_ / (numerics_.safety * share);
        const Easing eased = ease_step(spheres, bonds, materials, weight_, contacts, walls, clusters, skin_, wanted, left, bound_);
        scaling_.added_later += eased.added / whole;
        ledger_.background += eased.energy;
        stable_ = std::min(share * eased.dt, bodies);
    }
    dt_ = std::min(dt_, numerics_.safety * stable_);
    constexpr double crushed = 0.01; // of the first step: whoever asks for less has lost its form
    if (bodies <= stable_ && dt_ < crushed * first_dt_) {
        throw NumericalFailure(text("at step ", steps_, " (time ", time_,
                                    " s) a deformable body has been stretched or crushed so far that "
                                    "its stable step fell from ",
                                    first_dt_, " s to ", dt_, " s: a membrane that bursts is too thin or too soft for its pressure"));
    }
}

void Model::follow_bodies() {
    for (auto& body : walls.bodies) {
        body.skin.follow(body.solid.position, body.solid.velocity, *team_);
    }
}

// The rows of the loads follow the lists of pairs.
void Model::arrange() { loads.arrange({{bonds.i, bonds.j, bonds.row_j}, {contacts.i, contacts.j, contacts.row_j}}); }

// All forces on a block's spheres among themselves, on later spheres and by boundaries. Touches nothing that another block touches.
void Model::block_forces(std::size_t k, const BondView& view, const ContactView& touching, double elapsed, bool measure) {
    const SphereBlock& block = loads.blocks()[k];
    BlockSums& out = block_sums_[k];
    out.failures.clear();
    loads.clear_kept(block);
    out.bonds = bond_forces(spheres.view(), bonds, view, k, loads.rows(), elapsed, measure, out.failures);
    out.contacts = contact_forces(spheres.view(), contacts, touching, k, elapsed, dt_, loads);
    out.walls.clear();
    for (auto& platen : walls.platens) {
        out.walls.push_back(platen_forces(spheres, platen, block, elapsed, dt_, loads));
    }
    for (auto& surface : walls.surfaces) {
        out.walls.push_back(surface_forces(spheres, surface, k, block, elapsed, dt_, loads));
    }
    out.bodies.clear();
    for (auto& body : walls.bodies) {
        out.bodies.push_back(deformable_forces(spheres, body, k, block, elapsed, dt_, loads));
    }
    out.pressure = 0.0;
    for (auto& pressure : pressures) {
        out.pressure += pressure_forces(spheres, pressure, block, elapsed, loads);
    }
}

// The averaged part of the stress at the spheres' positions now.
void Model::average() {
    const auto& blocks = loads.blocks();
    const auto bonds_of = [&](std::size_t k, auto&& work) {
        const auto first = bonds.first_block[k];
        const auto last = bonds.first_block[k + 1];
        if (first < last) {
            work(bonds.blocks[first].begin, bonds.blocks[last - 1].end);
        }
    };
    team_->run(blocks.size(), [&](std::size_t k) {
        bonds_of(k, [&](std::size_t begin, std::size_t end) { measure_elongations(spheres, bonds, begin, end); });
    });
    team_->run(blocks.size(), [&](std::size_t k) { measure_dilatation(bonds, blocks[k].begin, blocks[k].end); });
    team_->run(blocks.size(),
               [&](std::size_t k) { bonds_of(k, [&](std::size_t begin, std::size_t end) { set_shifts(bonds, begin, end); }); });
}

// elapsed: time since the last forces, over which springs are extended and energies counted.
void Model::forces(double elapsed, bool measure) {
    failures_.clear();
    for (auto& pressure : pressures) {
        pressure.force.resize(pressure.sphere.size());
    }
    const bool keep = measure || averaged_;
    prepare_bond_forces(bonds, keep);
    if (bonds.dilatation.active()) {
        average();
    }
    for (auto& body : walls.bodies) {
        const double before = body.solid.plastic();
        body.solid.forces(*team_);
        ledger_.plastic += body.solid.plastic() - before;
        body.skin.follow(body.solid.position, body.solid.velocity, *team_);
        body.sums = {};
    }
    const BondView view = bonds.view();
    const ContactView touching = contacts.view();
    team_->run(loads.blocks().size(), [&](std::size_t k) { block_forces(k, view, touching, elapsed, keep); });

    double stored = 0.0;
    std::vector<WallSums> at_walls(walls.platens.size() + walls.surfaces.size());
    for (const auto& sums : block_sums_) {
        ledger_.damage += sums.bonds.damage;
        ledger_.plastic += sums.bonds.plastic;
        ledger_.friction += sums.bonds.friction + sums.contacts.friction;
        ledger_.dashpots += sums.bonds.dashpot + sums.contacts.dashpot;
        ledger_.pressure += sums.pressure;
        stored += sums.contacts.stored;
        for (std::size_t p = 0; p < at_walls.size(); ++p) {
            at_walls[p].add(sums.walls[p]);
        }
        for (std::size_t p = 0; p < walls.bodies.size(); ++p) {
            walls.bodies[p].sums.add(sums.bodies[p]);
        }
        failures_.insert(failures_.end(), sums.failures.begin(), sums.failures.end());
    }
    broken_ += failures_.size();
    for (auto& body : walls.bodies) {
        collect_node_loads(body);
        body.crossings += static_cast<std::int64_t>(body.sums.crossed);
        ledger_.friction += body.sums.friction;
        ledger_.dashpots += body.sums.dashpot;
        ledger_.coupling += steps_ > 0 ? body.sums.made : 0.0; // what presses from the start is counted there
    }
    for (const auto& sums : at_walls) {
        ledger_.friction += sums.friction;
        ledger_.dashpots += sums.dashpot;
        stored += sums.stored;
    }
    for (std::size_t p = 0; p < walls.platens.size(); ++p) {
        Platen& platen = walls.platens[p];
        platen.reaction = at_walls[p].reaction;
        platen.thrust = at_walls[p].thrust;
        platen.touching = at_walls[p].touching;
        // The platen pushes back with -reaction while it moves by velocity dt.
        ledger_.platens -= 0.5 * platen.face.axis.dot(platen.reaction + reactions_[p]) * platen.velocity * elapsed;
        reactions_[p] = platen.reaction;
    }
    for (std::size_t p = 0; p < walls.surfaces.size(); ++p) {
        Surface& surface = walls.surfaces[p];
        const WallSums& before = surface.sums;
        const WallSums& now = at_walls[walls.platens.size() + p];
        ledger_.platens -=
            0.5 * elapsed *
            (surface.motion.velocity.dot(before.reaction + now.reaction) + surface.motion.spin.dot(before.torque + now.torque));
        surface.sums = now;
    }
    if (averaged_) {
        fail_by_averaged_stress();
    }
    if (measure) {
        ledger_.elastic = std::accumulate(bonds.stored.begin(), bonds.stored.end(), stored) + dilatation_energy(bonds) + energy_of_bodies();
    }
}

// Bonds whose spheres' averaged stress has passed their criterion fail now, in bond order.
void Model::fail_by_averaged_stress() {
    const auto single = sphere_stresses(spheres, bonds, contacts, walls, pressures, volume_);
    averaged_criteria(bonds, vicinity_stresses(bonds, single, volume_), averaged_value_, shear_governs_);
    for (const auto& block : bonds.blocks) {
        const BondLaw& law = bonds.laws[block.law];
        if (law.criterion == Criterion::bond) {
            continue;
        }
        for (std::uint32_t b = block.begin; b < block.end; ++b) {
            bonds.criterion[b] = std::min(averaged_value_[b], 1.0);
            if (bonds.mode[b] == 0 && averaged_value_[b] >= 1.0) {
                const auto mode = shear_governs_[b] ? FailureMode::shear : FailureMode::tension;
                ledger_.damage += fail_bond(spheres, bonds, b, law, mode, dt_, loads);
                failures_.push_back({b, mode});
                ++broken_;
            }
        }
    }
}

// Work of gravity since the start.
double Model::body_work() const {
    double sum = body_gone_;
    for (std::size_t k = 0; k < clusters.alone(spheres); ++k) {
        sum += (scaling_.mass.empty() ? spheres.mass[k] : scaling_.mass[k]) *
               numerics_.gravity.dot(spheres.position.at(k) - spheres.start.at(k));
    }
    for (std::size_t k = 0; k < clusters.size(); ++k) {
        sum += clusters.mass[k] * numerics_.gravity.dot(clusters.position[k] - clusters.start[k]);
    }
    return sum;
}

double Model::stable_step_of_bodies() const {
    double lowest = 1e300;
    for (const auto& body : walls.bodies) {
        lowest = std::min(lowest, proveta::stable_step(body, spheres, growth(), skin_));
    }
    return lowest;
}

double Model::energy_of_bodies() const {
    double sum = 0.0;
    for (const auto& body : walls.bodies) {
        sum += body.solid.stored() + body.sums.stored;
    }
    return sum;
}

// Moves the deformable bodies and returns the highest speed of a node.
double Model::move_bodies(const std::vector<double>& speeds, bool measure) {
    std::vector<Vec3> platens;
    for (std::size_t p = 0; p < walls.platens.size() && p < speeds.size(); ++p) {
        platens.emplace_back(speeds[p] * walls.platens[p].face.axis);
    }
    double fastest = 0.0;
    bodies_kinetic_ = 0.0;
    for (auto& body : walls.bodies) {
        const SolidSums sums = body.solid.move(*team_, dt_, steps_ == 0, numerics_.gravity, platens, 0.5 * (last_dt_ + dt_));
        ledger_.platens += sums.held;
        ledger_.pressure += sums.pressure;
        ledger_.dashpots += sums.rayleigh;
        bodies_weighed_ += sums.body;
        bodies_kinetic_ += sums.kinetic;
        fastest = std::isfinite(sums.fastest) ? std::max(fastest, sums.fastest) : sums.fastest;
    }
    if (measure && !numerics_.gravity.isZero()) {
        ledger_.body = body_work() + bodies_weighed_;
    }
    return fastest;
}

// Moves spheres, then clusters, part by part.
MotionSums Model::move(bool measure) {
    const bool first = steps_ == 0;
    const MotionRule rule{numerics_.scheme, numerics_.damping, numerics_.gravity, 0.5 * (last_dt_ + dt_)};
    const auto& blocks = loads.blocks();
    const auto alone = static_cast<std::uint32_t>(clusters.alone(spheres));
    constexpr std::size_t bodies_per_part = 32;
    const std::size_t parts = (clusters.size() + bodies_per_part - 1) / bodies_per_part;
    block_motion_.resize(blocks.size() + parts);
    team_->run(blocks.size() + parts, [&](std::size_t k) {
        if (k >= blocks.size()) {
            const std::size_t begin = (k - blocks.size()) * bodies_per_part;
            block_motion_[k] = move_clusters(clusters, spheres, loads, begin, std::min(begin + bodies_per_part, clusters.size()), rule, dt_,
                                             first, measure);
            return;
        }
        SphereBlock block = blocks[k];
        block.end = std::min(block.end, alone);
        block_motion_[k] = block.begin < block.end ? move_spheres(spheres, loads, block, rule, dt_, first, measure) : MotionSums{};
    });
    MotionSums sums;
    for (const auto& part : block_motion_) {
        sums.damping_work += part.damping_work;
        sums.kinetic += part.kinetic;
        sums.unbalanced += part.unbalanced;
        sums.fastest = std::isnan(part.fastest) ? part.fastest : std::max(sums.fastest, part.fastest);
    }
    return sums;
}

void Model::motion(const std::vector<double>& speeds, bool measure) {
    const bool first = steps_ == 0;
    const double of_bodies = move_bodies(speeds, measure);
    const MotionSums sums = move(measure || first);
    if (first) {
        ledger_.initial = sums.kinetic + bodies_kinetic_ + ledger_.elastic;
    }
    double fastest = std::sqrt(sums.fastest);
    travel_.went(fastest * dt_);
    for (auto& track : tracks_) {
        track.spheres.went(fastest * dt_);
    }
    for (auto& track : body_tracks_) {
        track.went(fastest * dt_);
    }
    fastest = std::isfinite(of_bodies) ? std::max(fastest, of_bodies) : of_bodies;
    for (std::size_t p = 0; p < walls.platens.size(); ++p) {
        walls.platens[p].move(speeds[p], dt_);
        fastest = std::max(fastest, std::fabs(speeds[p]));
    }
    for (std::size_t p = 0; p < walls.surfaces.size(); ++p) {
        Surface& surface = walls.surfaces[p];
        surface.move(dt_);
        tracks_[p].way += (surface.motion.velocity.norm() + surface.motion.spin.norm() * surface.reach()) * dt_;
    }
    fastest_ = fastest;
    ledger_.background += sums.damping_work;
    if (measure) {
        ledger_.kinetic = sums.kinetic + bodies_kinetic_;
        double forces = 0.0;
        for (std::size_t b = 0; b < bonds.size(); ++b) {
            forces += std::hypot(bonds.normal[b], bonds.shear[b]);
        }
        for (std::size_t k = 0; k < contacts.size() && bonds.size() == 0; ++k) { // of loose matter
            forces += contacts.force.at(k).norm();
        }
        measures_.unbalanced_ratio = forces > 0.0 ? sums.unbalanced / forces : 0.0;
        check();
    }
}

void Model::restored() {
    const std::size_t n = contacts.i.size();
    contacts.normal.assign(n, 0.0);
    set_up_contacts(spheres, materials, weight_, contacts);
    set_up_walls(spheres, materials, walls);
    for (std::size_t p = 0; p < walls.platens.size(); ++p) {
        walls.platens[p].reaction = reactions_[p];
    }
    arrange();
    bonds.worn.assign(bonds.size(), 1);
    broken_ = bonds.size() - static_cast<std::size_t>(std::count(bonds.mode.begin(), bonds.mode.end(), std::uint8_t{0}));
    failures_.clear();
}

std::uint64_t Model::state_hash() const {
    Hash hash;
    for (const auto* f : {&spheres.position, &spheres.velocity, &spheres.spin, &bonds.slip, &contacts.slip}) {
        hash.mix(f->x);
        hash.mix(f->y);
        hash.mix(f->z);
    }
    for (const auto& body : walls.bodies) {
        for (const auto* field : {&body.solid.position, &body.solid.velocity}) {
            for (const Vec3& v : *field) {
                hash.mix(std::vector<double>(v.begin(), v.end()));
            }
        }
    }
    for (const auto* a : {&bonds.plastic, &bonds.damage_n, &bonds.damage_t, &bonds.damage_work}) {
        hash.mix(*a);
    }
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        hash.mix(static_cast<std::uint64_t>(contacts.i[k]) << 32 | static_cast<std::uint32_t>(contacts.j[k]));
    }
    return hash.value();
}

} // namespace proveta
