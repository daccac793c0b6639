#include "core/contacts/incidence.hpp"

namespace proveta {

Incidence make_incidence(std::size_t n, const std::vector<std::int32_t>& first, const std::vector<std::int32_t>& second) {
    Incidence out;
    out.offset.assign(n + 1, 0);
    for (std::size_t k = 0; k < first.size(); ++k) {
        ++out.offset[static_cast<std::size_t>(first[k]) + 1];
        ++out.offset[static_cast<std::size_t>(second[k]) + 1];
    }
    for (std::size_t s = 0; s < n; ++s) {
        out.offset[s + 1] += out.offset[s];
    }
    out.entry.resize(2 * first.size());
    std::vector<std::uint32_t> next(out.offset.begin(), out.offset.end() - 1);
    for (std::size_t k = 0; k < first.size(); ++k) {
        out.entry[next[static_cast<std::size_t>(first[k])]++] = static_cast<std::uint32_t>(2 * k);
        out.entry[next[static_cast<std::size_t>(second[k])]++] = static_cast<std::uint32_t>(2 * k + 1);
    }
    return out;
}

} // namespace proveta
