// Which of a kernel's compiled variants this machine runs. The kernels are compiled once per instruction set from one source
// (core/CMakeLists.txt); all give the same bits.
#pragma once

#include <string>

namespace proveta {

enum class InstructionSet { baseline, avx2, avx512 };

/// The best one that the processor has and the program was built with.
InstructionSet instruction_set();

/// "AVX-512", "AVX2" or "baseline".
std::string instruction_set_name();

/// Picks among three pointers to the variants of one kernel.
template <class Kernel> Kernel pick_variant(Kernel baseline, Kernel avx2, Kernel avx512) {
    const InstructionSet set = instruction_set();
    return set == InstructionSet::avx512 ? avx512 : set == InstructionSet::avx2 ? avx2 : baseline;
}

// The variant of a kernel that this machine runs, as PROVETA_PICK(bond_kernels). Builds of one variant (PROVETA_ONE_VARIANT) are for
// sanitizers and for other processors and have the baseline alone.
#ifdef PROVETA_ONE_VARIANT
#define PROVETA_PICK(name) name##_baseline
#else
#define PROVETA_PICK(name) proveta::pick_variant(name##_baseline, name##_avx2, name##_avx512)
#endif

} // namespace proveta
