#include "lab/trials/decks.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "lab/checks.hpp"
#include "lab/deck.hpp"

namespace proveta {

using input::Json;

namespace {

constexpr std::int64_t fewest_spheres = 50;

// Where a value of a parameter stands in the file.
std::string place(const Parameter& p, std::size_t k, double value, std::size_t level) {
    const std::string at = fmt::format("/parameters/{}", k);
    if (!p.values.empty()) {
        return fmt::format("{}/values/{}", at, level);
    }
    return value == p.low ? at + "/low" : value == p.high ? at + "/high" : at;
}

} // namespace

Json deck_for(const TrialTest& test, std::int64_t seed, double share) {
    Json deck = test.deck;
    if (!test.seeds.empty()) {
        auto& specimen = deck["specimen"];
        specimen["seed"] = seed;
        if (specimen.contains("spheres")) { // loose particles fill their cylinder
            specimen["spheres"] = std::max<std::int64_t>(fewest_spheres, std::llround(share * specimen["spheres"].get<double>()));
        }
    }
    return deck;
}

Job job_for(const TrialTest& test, std::int64_t seed, double share, const ParameterSpace& space, const std::vector<double>& values) {
    Job job{test.seeds.empty() ? test.name : fmt::format("{}_seed_{}", test.name, seed), test.name, deck_for(test, seed, share)};
    space.apply(job.deck, values);
    return job;
}

void check_decks(const ParameterSpace& space, const std::vector<TrialTest>& tests, const std::vector<std::vector<double>>& levels,
                 const std::string& file, input::Problems& problems) {
    std::set<std::string> said;
    const auto check = [&](const std::vector<double>& values, const std::string& where, const std::string& path) {
        for (const auto& test : tests) {
            const Job job = job_for(test, test.seeds.empty() ? 0 : test.seeds.front(), 1.0, space, values);
            try {
                read_deck(job.deck, file);
            } catch (const input::InputError& error) {
                for (const auto& p : error.problems) {
                    if (said.insert(p.path + p.expected).second) {
                        problems.push_back({file, path, fmt::format("{}: {} of test \"{}\" is {}", where, p.path, test.name, p.found),
                                            p.expected,
                                            p.suggestion.empty() ? "give other bounds; \"times\" keeps values in order" : p.suggestion});
                    }
                }
            }
        }
    };
    const auto middle = space.values(std::vector<double>(space.size(), 0.5));
    check(middle, "all parameters in the middle", "/parameters");
    if (!said.empty()) {
        return; // each level would only say it again
    }
    for (std::size_t k = 0; k < space.size(); ++k) {
        for (std::size_t level = 0; level < levels[k].size(); ++level) {
            auto values = middle;
            values[k] = levels[k][level];
            check(values, fmt::format("{} = {:.6g}, the others in the middle", space[k].name, values[k]),
                  place(space[k], k, values[k], level));
        }
    }
}

void look_at_specimens(const ParameterSpace& space, const std::vector<TrialTest>& tests, const std::string& file) {
    input::Problems problems;
    std::set<std::string> said;
    const auto middle = space.values(std::vector<double>(space.size(), 0.5));
    for (const auto& test : tests) {
        const Job job = job_for(test, test.seeds.empty() ? 0 : test.seeds.front(), 1.0, space, middle);
        try {
            for (const auto& warning : check_before(read_deck(job.deck, file))) {
                if (said.insert(warning).second) {
                    spdlog::warn("{}: {}", test.name, warning);
                }
            }
        } catch (const input::InputError& error) {
            for (const auto& p : error.problems) {
                problems.push_back(
                    {file, "/tests", fmt::format("{} of test \"{}\" is {}", p.path, test.name, p.found), p.expected, p.suggestion});
            }
        }
    }
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
}

} // namespace proveta
