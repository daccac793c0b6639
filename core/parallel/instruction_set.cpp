#include "core/parallel/instruction_set.hpp"

namespace proveta {

InstructionSet instruction_set() {
#ifndef PROVETA_ONE_VARIANT
    static const InstructionSet best = [] {
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
            return InstructionSet::avx512;
        }
        return __builtin_cpu_supports("avx2") ? InstructionSet::avx2 : InstructionSet::baseline;
    }();
    return best;
#else
    return InstructionSet::baseline;
#endif
}

std::string instruction_set_name() {
    switch (instruction_set()) {
    case InstructionSet::avx512: return "AVX-512";
    case InstructionSet::avx2: return "AVX2";
    default: return "baseline";
    }
}

} // namespace proveta
