// Studies: one test at several loading rates, time steps or numbers of spheres, and where its results go.
#pragma once

#include <string>
#include <vector>

#include "lab/series/member_result.hpp"
#include "lab/series/plan.hpp"
#include "lab/series/run_series.hpp"

namespace proveta {

/// What is varied.
enum class StudyKind {
    rate, ///< loading.rate: closing speed of the platens
    step, ///< numerics.safety: time step over the stable one
    size  ///< specimen.spheres
};

/// What a study's members differ by.
struct Study {
    StudyKind kind = StudyKind::rate;
    std::vector<double> values; ///< one a member: m/s, share of the stable step, or number of spheres
    std::vector<double> x;      ///< what is extrapolated to zero, one a member: the same, or the spacing of the spheres in m, (V/n)^(1/3)
};

/// What the command line adds to a deck.
struct StudyRequest {
    StudyKind kind = StudyKind::rate;
    std::string deck; ///< file
    std::vector<std::string> settings;
    std::vector<double> values; ///< empty: four, chosen about the deck's own
    int seeds = 1;              ///< specimens for each value, whose seeds count on from the deck's
};

/// The tests of a study, as a series that says what it varies. Throws InputError with every problem.
Plan plan_study(const StudyRequest& request);

/// What is to be made of a series whose plan says that it is a study, as those are that go on from or repeat one; nothing for others.
SeriesStudy study_of(const Plan& plan);

/// Means and spreads of every result at each value, its extrapolation, plots. Only complete members count.
SeriesExtra evaluate_study(const Study& study, const std::vector<MemberResult>& members);

} // namespace proveta
