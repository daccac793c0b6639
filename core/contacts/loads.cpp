#include "core/contacts/loads.hpp"

#include <algorithm>

namespace proveta {

ListedRange listed_in(const std::vector<std::int32_t>& spheres, const SphereBlock& block) {
    const auto at = [&](std::uint32_t sphere) {
        return static_cast<std::size_t>(std::lower_bound(spheres.begin(), spheres.end(), static_cast<std::int32_t>(sphere)) -
                                        spheres.begin());
    };
    return {at(block.begin), at(block.end)};
}

Loads::Loads(std::size_t spheres) : spheres_(spheres), rows_(spheres), offset_(spheres + 1, 0) {
    for (std::size_t begin = 0; begin < spheres; begin += spheres_per_block) {
        const auto end = std::min(spheres, begin + spheres_per_block);
        const auto none = static_cast<std::uint32_t>(spheres);
        blocks_.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end), none, none});
    }
}

void Loads::arrange(const std::vector<PairRows>& lists) {
    std::vector<std::int32_t> owner; // sphere of each kept row
    std::vector<std::int32_t> strangers;
    std::vector<std::size_t> begin(lists.size(), 0);
    for (const auto& list : lists) {
        list.row_j.resize(list.j.size());
    }
    for (auto& block : blocks_) {
        const auto own = [&](std::int32_t sphere) { return static_cast<std::uint32_t>(sphere) < block.end; }; // j > i, so not before it
        strangers.clear();
        std::vector<std::size_t> end = begin;
        for (std::size_t l = 0; l < lists.size(); ++l) {
            const auto& list = lists[l];
            for (; end[l] < list.i.size() && own(list.i[end[l]]); ++end[l]) {
                if (!own(list.j[end[l]])) {
                    strangers.push_back(list.j[end[l]]);
                }
            }
        }
        std::sort(strangers.begin(), strangers.end());
        strangers.erase(std::unique(strangers.begin(), strangers.end()), strangers.end());
        block.kept_begin = static_cast<std::uint32_t>(spheres_ + owner.size());
        for (std::size_t l = 0; l < lists.size(); ++l) {
            const auto& list = lists[l];
            for (std::size_t k = begin[l]; k < end[l]; ++k) {
                const auto at = std::lower_bound(strangers.begin(), strangers.end(), list.j[k]);
                list.row_j[k] = own(list.j[k]) ? list.j[k] : static_cast<std::int32_t>(block.kept_begin + (at - strangers.begin()));
            }
        }
        owner.insert(owner.end(), strangers.begin(), strangers.end());
        block.kept_end = static_cast<std::uint32_t>(spheres_ + owner.size());
        begin = std::move(end);
    }
    rows_.resize(spheres_ + owner.size());
    offset_.assign(spheres_ + 1, 0);
    for (const auto sphere : owner) {
        ++offset_[static_cast<std::size_t>(sphere) + 1];
    }
    for (std::size_t s = 0; s < spheres_; ++s) {
        offset_[s + 1] += offset_[s];
    }
    from_.resize(owner.size());
    auto next = offset_;
    for (std::size_t k = 0; k < owner.size(); ++k) {
        from_[next[static_cast<std::size_t>(owner[k])]++] = static_cast<std::uint32_t>(spheres_ + k);
    }
}

void Loads::add(std::size_t sphere, const Vec3& force, const Vec3& torque) {
    for (int c = 0; c < 3; ++c) {
        rows_[sphere].force[c] += force[c];
        rows_[sphere].torque[c] += torque[c];
    }
}

void Loads::clear_kept(const SphereBlock& block) { std::fill(rows_.begin() + block.kept_begin, rows_.begin() + block.kept_end, Load{}); }

void Loads::collect(const SphereBlock& block) {
    for (std::uint32_t k = block.begin; k < block.end; ++k) {
        Load& sum = rows_[k];
        for (auto e = offset_[k]; e < offset_[k + 1]; ++e) {
            const Load& kept = rows_[from_[e]];
            for (int c = 0; c < 3; ++c) {
                sum.force[c] += kept.force[c];
                sum.torque[c] += kept.torque[c];
            }
        }
    }
}

} // namespace proveta
