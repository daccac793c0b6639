// The forces of a step and what they add to the ledger.
#include <algorithm>
#include <numeric>

#include "core/averaged_stress.hpp"
#include "core/model.hpp"

namespace proveta {

// All forces on a block's spheres among themselves, on later spheres and by boundaries. Touches nothing that another block touches.
void Model::block_forces(std::size_t k, const BondView& view, const ContactView& touching, double elapsed, bool measure) {
    const SphereBlock& block = loads.blocks()[k];
    BlockSums& out = block_sums_[k];
    out.failures.clear();
    loads.clear_kept(block);
    out.bonds = bond_forces(spheres.view(), bonds, view, k, loads.rows(), elapsed, measure, out.failures);
    const ContactStep step{elapsed, dt_, numerics_.impacts, bonds.size() == 0};
    out.contacts = contact_forces(spheres.view(), contacts, touching, k, step, loads);
    out.walls.clear();
    for (auto& platen : walls.platens) {
        out.walls.push_back(platen_forces(spheres, platen, block, step, loads));
    }
    for (auto& surface : walls.surfaces) {
        out.walls.push_back(surface_forces(spheres, surface, k, block, step, loads));
    }
    out.bodies.clear();
    for (auto& body : walls.bodies) {
        out.bodies.push_back(deformable_forces(spheres, body, k, block, step, loads));
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
    if (bonds.volumetric.active() && steps_ % VolumetricStrain::every == 0) {
        const auto& blocks = loads.blocks();
        team_->run(blocks.size(), [&](std::size_t k) { measure_volumetric_strain(spheres, bonds, blocks[k].begin, blocks[k].end); });
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
        largest_overlap_ = std::max(largest_overlap_, sums.contacts.deepest);
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
        largest_overlap_ = std::max(largest_overlap_, body.sums.deepest);
        ledger_.coupling += steps_ > 0 ? body.sums.made : 0.0; // what presses from the start is counted there
    }
    for (const auto& sums : at_walls) {
        ledger_.friction += sums.friction;
        ledger_.dashpots += sums.dashpot;
        stored += sums.stored;
        largest_overlap_ = std::max(largest_overlap_, sums.deepest);
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
        const BondGroup& group = bonds.groups[block.group];
        if (group.criterion.kind == Criterion::bond) {
            continue;
        }
        for (std::uint32_t b = block.begin; b < block.end; ++b) {
            bonds.criterion[b] = std::min(averaged_value_[b], 1.0);
            if (bonds.mode[b] == 0 && averaged_value_[b] >= 1.0) {
                const auto mode = shear_governs_[b] ? FailureMode::shear : FailureMode::tension;
                ledger_.damage += fail_bond(spheres, bonds, b, group, mode, dt_, loads);
                failures_.push_back({b, mode});
                ++broken_;
            }
        }
    }
}

double Model::energy_of_bodies() const {
    double sum = 0.0;
    for (const auto& body : walls.bodies) {
        sum += body.solid.stored() + body.sums.stored;
    }
    return sum;
}

} // namespace proveta
