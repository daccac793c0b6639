#include "lab/series/seed_groups.hpp"

#include <algorithm>
#include <cctype>
#include <map>

namespace proveta {

namespace {

// The deck but for its seed and title.
std::string recipe_of(const Deck& deck) {
    input::Json json = resolved(deck);
    json.erase("title");
    json["specimen"].erase("seed");
    return json.dump();
}

std::vector<ScalarSample> statistics_of(const std::vector<MemberResult>& members, const std::vector<std::size_t>& group) {
    std::vector<ScalarSample> out;
    for (const auto& scalar : members[group.front()].results) {
        std::vector<double> values;
        for (const std::size_t k : group) {
            if (const auto value = members[k].value(scalar.name)) {
                values.push_back(*value);
            }
        }
        ScalarSample one{scalar, sample_of(values)};
        one.scalar.value = values.empty() ? std::nullopt : std::optional(one.sample.mean);
        out.push_back(std::move(one));
    }
    return out;
}

} // namespace

std::string name_without_seed(const std::string& name) {
    const auto at = name.rfind("seed_");
    const bool last = at != std::string::npos && at + 5 < name.size() &&
                      std::all_of(name.begin() + static_cast<std::ptrdiff_t>(at) + 5, name.end(),
                                  [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; });
    if (!last || (at > 0 && name[at - 1] != '_')) {
        return name;
    }
    return at == 0 ? "seeds" : name.substr(0, at - 1);
}

std::vector<SeedGroup> seed_groups(const std::vector<MemberResult>& members) {
    std::vector<std::pair<std::string, std::vector<std::size_t>>> groups;
    for (std::size_t k = 0; k < members.size(); ++k) {
        const std::string recipe = recipe_of(members[k].member->deck);
        const auto at = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == recipe; });
        (at != groups.end() ? at->second : groups.emplace_back(recipe, std::vector<std::size_t>{}).second).push_back(k);
    }
    std::vector<SeedGroup> out;
    for (auto& [recipe, indices] : groups) {
        if (indices.size() < 2) {
            continue;
        }
        SeedGroup group;
        group.name = name_without_seed(members[indices.front()].member->name);
        group.members = indices;
        std::vector<std::size_t> complete;
        for (const std::size_t k : indices) {
            if (members[k].complete() && members[k].curve) {
                complete.push_back(k);
                group.curves.push_back(members[k].curve->values);
            }
        }
        if (!complete.empty()) {
            group.statistics = statistics_of(members, complete);
            group.of = members[complete.front()].curve;
        }
        group.mean =
            complete.size() < 2 ? Outcome<MeanCurve>{std::nullopt, "fewer than two of the tests are complete"} : mean_curve(group.curves);
        out.push_back(std::move(group));
    }
    return out;
}

} // namespace proveta
