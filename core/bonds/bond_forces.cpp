#include "core/bonds/bond_forces.hpp"

#include "core/parallel/instruction_set.hpp"

namespace proveta {

void prepare_bond_forces(Bonds& bonds, bool measure) {
    if (measure && bonds.normal.size() != bonds.size()) {
        for (auto* array : {&bonds.normal, &bonds.shear, &bonds.criterion, &bonds.stored}) {
            array->resize(bonds.size());
        }
        bonds.force.resize(bonds.size());
    }
}

BondDissipation bond_forces(const SphereView& spheres, const Bonds& bonds, const BondView& view, std::size_t block, double* rows, double dt,
                            bool measure, std::vector<BondFailure>& failures) {
    static const BondKernel* const kernels = PROVETA_PICK(bond_kernels)();
    BondDissipation sum;
    for (auto r = bonds.first_block[block]; r < bonds.first_block[block + 1]; ++r) {
        const BondBlock& run = bonds.blocks[r];
        RunResult result;
        const BondGroup& group = bonds.groups[run.group];
        const void* constants = std::visit([](const auto& c) -> const void* { return &c; }, group.law);
        kernels[group.law.index()](spheres, view, constants, group.beams, rows, run.begin, run.end, dt, measure, result);
        sum.damage += result.dissipation.damage;
        sum.plastic += result.dissipation.plastic;
        sum.friction += result.dissipation.friction;
        sum.dashpot += result.dissipation.dashpot;
        for (std::uint32_t k = 0; k < result.failed; ++k) {
            const auto b = view.failures[run.begin + k];
            failures.push_back({b, static_cast<FailureMode>(bonds.mode[b])});
        }
    }
    return sum;
}

} // namespace proveta
