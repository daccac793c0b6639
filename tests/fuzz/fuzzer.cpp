// A fuzzer: libFuzzer's entry to one of the targets, PROVETA_TARGET.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    proveta::fuzz::PROVETA_TARGET({reinterpret_cast<const char*>(data), size});
    return 0;
}
