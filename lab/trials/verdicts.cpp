#include "lab/trials/verdicts.hpp"

#include <algorithm>

namespace proveta {

using input::Json;

namespace {

struct Verdict {
    std::string words;
    std::size_t tests = 0;
    std::size_t good = 0;
    std::size_t checked = 0;
    double largest = 0.0;

    void add(const JobResult& job) {
        const bool first_bad = !job.quasi_static && good == tests;
        if (tests == 0 || first_bad) {
            words = job.verdict;
        }
        ++tests;
        good += job.quasi_static ? 1 : 0;
        if (job.rate_difference) {
            ++checked;
            largest = std::max(largest, *job.rate_difference);
        }
    }
};

} // namespace

Json verdicts_of(const std::vector<TrialResult>& trials) {
    std::vector<std::pair<std::string, Verdict>> found; // in the order of the tests
    for (const auto& trial : trials) {
        for (const auto& job : trial.jobs) {
            if (job.status != "complete") {
                continue;
            }
            auto at = std::find_if(found.begin(), found.end(), [&](const auto& entry) { return entry.first == job.test; });
            if (at == found.end()) {
                at = found.insert(found.end(), {job.test, {}});
            }
            at->second.add(job);
        }
    }
    Json out = Json::object();
    for (const auto& [test, v] : found) {
        out[test] = {{"good", v.good == v.tests}, {"verdict", v.words},
                     {"tests", v.tests},          {"good_tests", v.good},
                     {"rate_checked", v.checked}, {"largest_rate_difference", v.checked > 0 ? Json(v.largest) : Json()}};
    }
    return out;
}

} // namespace proveta
