#include "lab/citation.hpp"

#include <fmt/format.h>

#include "lab/provenance.hpp"

namespace proveta {

std::string citation(const std::string& what, const std::string& title, const input::Json& input) {
    const std::string text = input.dump(-1, ' ', false, input::Json::error_handler_t::replace);
    return fmt::format("Proveta {}, a discrete-element virtual materials laboratory. {} \"{}\", input hash {}, computed {}.", version(),
                       what, title, hash_of_text(text), now_utc().substr(0, 10));
}

} // namespace proveta
