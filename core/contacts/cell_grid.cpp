#include "core/contacts/cell_grid.hpp"

#include <algorithm>
#include <cmath>

namespace proveta {

CellGrid::CellGrid(const VectorField& positions, double width) {
    const std::size_t n = positions.size();
    cell_of_.resize(n);
    Vec3 low = Vec3::Zero();
    Vec3 high = Vec3::Zero();
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3 p = positions.at(k);
        low = k == 0 ? p : Vec3(low.cwiseMin(p));
        high = k == 0 ? p : Vec3(high.cwiseMax(p));
    }
    const Vec3 extent = high - low;
    const double most = 2.0 * static_cast<double>(n) + 64.0;
    auto cells = [&](double w) {
        double product = 1.0;
        for (int c = 0; c < 3; ++c) {
            product *= std::floor(extent[c] / w) + 1.0;
        }
        return product;
    };
    while (cells(width) > most) {
        width *= 1.26;
    }
    for (int c = 0; c < 3; ++c) {
        count_[static_cast<std::size_t>(c)] = static_cast<std::int64_t>(extent[c] / width) + 1;
    }
    offset_.assign(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]) + 1, 0);
    auto number = [&](const std::array<std::int32_t, 3>& c) {
        return static_cast<std::size_t>((c[2] * count_[1] + c[1]) * count_[0] + c[0]);
    };
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3 at = (positions.at(k) - low) / width;
        for (int c = 0; c < 3; ++c) {
            cell_of_[k][static_cast<std::size_t>(c)] = static_cast<std::int32_t>(at[c]);
        }
        ++offset_[number(cell_of_[k]) + 1];
    }
    for (std::size_t c = 1; c < offset_.size(); ++c) {
        offset_[c] += offset_[c - 1];
    }
    items_.resize(n);
    std::vector<std::uint32_t> next(offset_.begin(), offset_.end() - 1);
    for (std::size_t k = 0; k < n; ++k) {
        items_[next[number(cell_of_[k])]++] = static_cast<std::uint32_t>(k);
    }
}

std::vector<Pair> find_pairs(const VectorField& positions, const std::vector<double>& radii, double factor, double gap, Team* team) {
    const std::size_t n = radii.size();
    if (n < 2) {
        return {};
    }
    const double largest = *std::max_element(radii.begin(), radii.end());
    const CellGrid grid(positions, 2.0 * factor * largest + gap);
    // In the order of the cells, so that what is compared lies side by side in memory.
    const auto& items = grid.items();
    VectorField at(n);
    std::vector<double> radius(n);
    for (std::size_t k = 0; k < n; ++k) {
        at.set(k, positions.at(items[k]));
        radius[k] = radii[items[k]];
    }
    constexpr std::size_t block = 256;
    std::vector<std::vector<Pair>> found((n + block - 1) / block);
    const auto look = [&](std::size_t part) {
        auto& mine = found[part];
        for (std::size_t i = part * block; i < std::min(n, (part + 1) * block); ++i) {
            const auto before = static_cast<std::ptrdiff_t>(mine.size());
            const Vec3 here = positions.at(i);
            grid.runs(i, [&](std::uint32_t begin, std::uint32_t end) {
                for (auto k = begin; k < end; ++k) {
                    const double dx = at.x[k] - here.x();
                    const double dy = at.y[k] - here.y();
                    const double dz = at.z[k] - here.z();
                    const double reach = factor * (radii[i] + radius[k]) + gap;
                    if (dx * dx + dy * dy + dz * dz <= reach * reach && items[k] > i) {
                        mine.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(items[k])});
                    }
                }
            });
            std::sort(mine.begin() + before, mine.end());
        }
    };
    if (team != nullptr) {
        team->run(found.size(), look);
    } else {
#pragma omp parallel for schedule(dynamic) if (found.size() > 2)
        for (std::size_t part = 0; part < found.size(); ++part) {
            look(part);
        }
    }
    std::size_t count = 0;
    for (const auto& part : found) {
        count += part.size();
    }
    std::vector<Pair> pairs;
    pairs.reserve(count);
    for (auto& part : found) {
        pairs.insert(pairs.end(), part.begin(), part.end());
        std::vector<Pair>().swap(part);
    }
    return pairs;
}

} // namespace proveta
