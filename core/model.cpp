#include "core/model.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <sstream>

#include "core/averaged_stress.hpp"
#include "core/hash.hpp"

namespace proveta {

namespace {

std::string step_is_unstable(double asked, double stable) {
    std::ostringstream out;
    out.precision(4);
    out << "the time step of " << asked << " s is above the stable one of " << stable << " s";
    return out.str();
}

} // namespace

UnstableStep::UnstableStep(double asked_step, double stable_step)
    : std::runtime_error(step_is_unstable(asked_step, stable_step)), asked(asked_step), stable(stable_step) {}

Model::Model(Spheres s, std::vector<Material> m, Bonds b, std::vector<double> weight, Walls rigid, const Numerics& numerics,
             Clusters bodies)
    : spheres(std::move(s)), materials(std::move(m)), bonds(std::move(b)), clusters(std::move(bodies)), walls(std::move(rigid)),
      weight_(std::move(weight)), numerics_(numerics), bound_(spheres, bonds), team_(std::make_unique<Team>(omp_get_max_threads())) {
    mean_radius_ = mean_radius(spheres);
    skin_ = numerics_.skin * mean_radius_;
    reactions_.assign(walls.platens.size(), Vec3::Zero());
    averaged_ =
        std::any_of(bonds.groups.begin(), bonds.groups.end(), [](const BondGroup& g) { return g.criterion.kind != Criterion::bond; });
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
    scaling_.step_before *= damping_share();
    scaling_.step_after *= damping_share();
    stable_ = std::min(scaling_.step_after, stable_step_of_bodies());
    dt_ = numerics_.safety * stable_;
    if (numerics_.time_step) {
        dt_ = *numerics_.time_step;
        if (dt_ > stable_ && numerics_.refuse_unstable) {
            throw UnstableStep(dt_, stable_);
        }
    }
    if (numerics_.impact_steps > 0.0) {
        dt_ = std::min(dt_, impact_step(spheres, contacts, walls, skin_, numerics_.impact_steps));
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
    // One list serves to store and to restore, so it is not const; who only reads leaves everything as it is.
    const_cast<Model&>(*this).visit_state([&](const std::string& name, const auto& value) {
        hash.mix(name.data(), name.size());
        hash.mix_value(value);
    });
    return hash.value();
}

} // namespace proveta
