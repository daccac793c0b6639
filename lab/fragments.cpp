#include "lab/fragments.hpp"

#include <algorithm>
#include <numeric>

namespace proveta {

std::vector<int> fragments(const Model& model) { return fragments(model.bonds, model.spheres.size()); }

std::vector<int> fragments(const Bonds& bonds, std::size_t n) {
    std::vector<std::size_t> parent(n);
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t k) {
        while (parent[k] != k) {
            parent[k] = parent[parent[k]];
            k = parent[k];
        }
        return k;
    };
    for (std::size_t b = 0; b < bonds.size(); ++b) {
        if (bonds.mode[b] == 0) {
            parent[root(static_cast<std::size_t>(bonds.i[b]))] = root(static_cast<std::size_t>(bonds.j[b]));
        }
    }
    std::vector<std::size_t> size(n, 0);
    for (std::size_t k = 0; k < n; ++k) {
        ++size[root(k)];
    }
    std::vector<std::size_t> roots;
    for (std::size_t k = 0; k < n; ++k) {
        if (size[k] > 0) {
            roots.push_back(k);
        }
    }
    std::stable_sort(roots.begin(), roots.end(), [&](auto a, auto b) { return size[a] > size[b]; });
    std::vector<int> number(n, 0);
    for (std::size_t k = 0; k < roots.size(); ++k) {
        number[roots[k]] = static_cast<int>(k);
    }
    std::vector<int> out(n);
    for (std::size_t k = 0; k < n; ++k) {
        out[k] = number[root(k)];
    }
    return out;
}

std::vector<std::size_t> fragment_sizes(const std::vector<int>& fragments) {
    std::vector<std::size_t> size(
        fragments.empty() ? 0 : static_cast<std::size_t>(*std::max_element(fragments.begin(), fragments.end())) + 1, 0);
    for (const int f : fragments) {
        ++size[static_cast<std::size_t>(f)];
    }
    return size;
}

std::vector<std::uint8_t> detached_spheres(const Model& model) {
    if (model.bonds.size() == 0) {
        return std::vector<std::uint8_t>(model.spheres.size(), 0); // loose matter: nothing to come off
    }
    const auto number = fragments(model);
    const auto size = fragment_sizes(number);
    std::vector<std::uint8_t> out(number.size());
    std::transform(number.begin(), number.end(), out.begin(),
                   [&](int f) { return size[static_cast<std::size_t>(f)] * 100 < number.size() ? std::uint8_t{1} : std::uint8_t{0}; });
    return out;
}

} // namespace proveta
