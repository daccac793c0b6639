// Members that are equal but for the seed of their specimens: one material, several packings.
#pragma once

#include <string>
#include <vector>

#include "lab/series/member_result.hpp"
#include "lab/series/statistics.hpp"

namespace proveta {

/// A result over the members of a group.
struct ScalarSample {
    report::Scalar scalar; ///< name, title, unit and formula; its value is the mean
    Sample sample;         ///< of the members that have a value
};

struct SeedGroup {
    std::string name;
    std::vector<std::size_t> members; ///< indices, two at least
    std::vector<ScalarSample> statistics;
    Outcome<MeanCurve> mean;          ///< of the members' main curves
    std::vector<SampledCurve> curves; ///< that the mean is made of
    std::optional<MainCurve> of;      ///< the first of them, for its columns and axes
};

/// Groups of two or more members, in the order of their first; statistics and mean curve are of the members that are complete.
std::vector<SeedGroup> seed_groups(const std::vector<MemberResult>& members);

/// What a member's name says but for its seed: "p_4.5MPa" of "p_4.5MPa_seed_2", "seeds" of "seed_2".
std::string name_without_seed(const std::string& name);

} // namespace proveta
