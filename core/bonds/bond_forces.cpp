#include "core/bonds/bond_forces.hpp"

namespace proveta {

namespace {

struct Variant {
    BondKernel run;
    const char* name;
};

Variant best_variant() {
#ifdef PROVETA_X86
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
        return {bond_kernel_avx512, "AVX-512"};
    }
    if (__builtin_cpu_supports("avx2")) {
        return {bond_kernel_avx2, "AVX2"};
    }
#endif
    return {bond_kernel_baseline, "baseline"};
}

const Variant& variant() {
    static const Variant chosen = best_variant();
    return chosen;
}

} // namespace

std::string bond_kernel_name() { return variant().name; }

BondDissipation bond_forces(const Spheres& spheres, Bonds& bonds, double dt, bool measure, std::vector<BondFailure>& failures) {
    if (measure) {
        for (auto* array : {&bonds.normal, &bonds.shear, &bonds.criterion, &bonds.stored}) {
            array->resize(bonds.size());
        }
    }
    const std::size_t blocks = bonds.blocks.size();
    thread_local std::vector<BlockResult> scratch; // of the calling thread; the team shares it by reference
    scratch.resize(blocks);
    auto& results = scratch;
    const auto run = variant().run;
    const SphereView view = spheres.view();
    const BondView bond_view = bonds.view();
#pragma omp parallel for schedule(static) if (blocks > 1)
    for (std::size_t k = 0; k < blocks; ++k) {
        const BondBlock& block = bonds.blocks[k];
        run(view, bond_view, bonds.laws[block.law], block.begin, block.end, dt, measure, results[k]);
    }
    BondDissipation sum;
    for (const auto& r : results) {
        sum.damage += r.dissipation.damage;
        sum.plastic += r.dissipation.plastic;
        sum.friction += r.dissipation.friction;
        sum.dashpot += r.dissipation.dashpot;
        for (std::uint32_t k = 0; k < r.failed; ++k) {
            failures.push_back({r.failures[k], static_cast<FailureMode>(bonds.mode[r.failures[k]])});
        }
    }
    return sum;
}

} // namespace proveta
