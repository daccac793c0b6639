#include "lab/citation.hpp"

#include <fmt/format.h>

#include "core/hash.hpp"
#include "lab/provenance.hpp"

namespace proveta {

std::string citation(const std::string& what, const std::string& title, const input::Json& input) {
    Hash hash;
    for (const char c : input.dump(-1, ' ', false, input::Json::error_handler_t::replace)) {
        hash.mix(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
    }
    return fmt::format("Proveta {}, a discrete-element virtual materials laboratory. {} \"{}\", input hash {}, computed {}.", version(),
                       what, title, hex(hash.value()), now_utc().substr(0, 10));
}

} // namespace proveta
