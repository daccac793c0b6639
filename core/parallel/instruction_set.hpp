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
template <class Kernel> Kernel pick_variant(Kernel baseline, [[maybe_unused]] Kernel avx2, [[maybe_unused]] Kernel avx512) {
#ifdef PROVETA_X86
    const InstructionSet set = instruction_set();
    return set == InstructionSet::avx512 ? avx512 : set == InstructionSet::avx2 ? avx2 : baseline;
#else
    return baseline;
#endif
}

} // namespace proveta
