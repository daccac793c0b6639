#include "lab/calibrate/target_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/input/suggest.hpp"
#include "core/input/units.hpp"
#include "lab/calibrate/plausible.hpp"
#include "lab/results.hpp"

namespace proveta {

using input::Json;

namespace {

// Whether a result can be negative in the sense of its test.
bool may_be_negative(const std::string& result) {
    for (const char* part : {"slope", "toe", "volumetric", "circumferential", "lateral", "dilat", "magnitude", "angle", "completeness"}) {
        if (result.find(part) != std::string::npos) {
            return true;
        }
    }
    return false;
}

// What a test's own deck says against a value that it should come to; empty: nothing.
std::string against_deck(const TargetInput& t, const Json& deck, const std::string& unit) {
    const auto number = [&](const char* path) {
        const Json::json_pointer at(path);
        return deck.contains(at) && deck[at].is_number() ? deck[at].get<double>() : 0.0;
    };
    const double end = number("/loading/stop/axial_strain");
    if (end > 0.0 && t.result == "strain_at_peak" && t.value > end) {
        return fmt::format("a strain before loading.stop.axial_strain, {:.4g}, where the test ends", end);
    }
    const double pressure = number("/loading/confining_pressure");
    if (t.result == "strength" && t.value <= pressure) {
        return fmt::format("a total stress, which is above the confining pressure of {:.4g} MPa", 1e-6 * pressure);
    }
    constexpr double unlike = 300.0; // a card may be far from the material yet; a thousand is a unit
    const double young = number("/material/young_modulus");
    if (t.result == "young_modulus" && young > 0.0 && (t.value > unlike * young || t.value < young / unlike)) {
        return fmt::format("a modulus in {} as the deck's card has it, {:.4g} GPa; this is {:.2g} times that", unit, 1e-9 * young,
                           t.value / young);
    }
    return "";
}

} // namespace

void check_target(const TargetInput& t, const std::string& at, const std::vector<std::string>& tests, const std::string& file,
                  input::Problems& problems) {
    const auto complain = [&](const char* key, const std::string& found, const std::string& expected, const std::string& hint = "") {
        const std::string path = at + key; // a value that could not be read has been complained of, and is not there
        if (std::none_of(problems.begin(), problems.end(), [&](const input::Problem& p) { return p.path == path; })) {
            problems.push_back({file, path, found, expected, hint});
        }
    };
    if (std::find(tests.begin(), tests.end(), t.test) == tests.end()) {
        complain("/test", "\"" + t.test + "\"", fmt::format("the name of a test: {}", fmt::join(tests, ", ")));
    }
    if (t.is_curve() == !t.result.empty()) {
        complain("", t.is_curve() ? "a result and a curve" : "neither result nor curve", "one of \"result\" with \"value\", and \"curve\"");
    }
    if (!t.is_curve() && t.value == 0.0) {
        complain("/value", "nothing, or 0", "a value other than 0, to which the tolerance is relative");
    }
    if (t.tolerance > 1.0) {
        complain("/tolerance", fmt::format("{:.6g}", t.tolerance), "a share of at most 1", "5 % is 0.05, or \"5 %\"");
    }
    if (t.is_curve() && t.y.empty()) {
        complain("/y", "nothing", "what the curve shows: \"total_stress\", \"deviatoric_stress\" or a strain",
                 "total and deviatoric stress differ by the confining pressure");
    }
    if (t.is_curve() && t.x_offset != 0.0 && t.toe == "removed") {
        complain("/x_offset", fmt::format("{:.6g} beside \"toe\": \"removed\"", t.x_offset),
                 "one of the two, both of which take off strain");
    }
    if (t.is_curve() && t.from.word.empty() && t.to.word.empty() && !(t.from.number < t.to.number)) {
        complain("/from", fmt::format("{:.6g}, to {:.6g}", t.from.number, t.to.number), "from below to");
    }
    if (t.is_curve() && t.y == t.x) {
        complain("/y", "\"" + t.y + "\" over itself", "another quantity than x");
    }
}

// A result that the test cannot have, or that cannot have such a value, is said before anything runs.
void check_result(const TargetInput& t, const Json& written, const std::string& at, const std::vector<TrialTest>& tests,
                  const std::string& file, input::Problems& problems) {
    const auto test = std::find_if(tests.begin(), tests.end(), [&](const TrialTest& one) { return one.name == t.test; });
    const auto said = [&](const char* key) {
        return std::any_of(problems.begin(), problems.end(), [&](const input::Problem& p) { return p.path == at + key; });
    };
    if (t.result.empty() || test == tests.end() || said("/result")) {
        return;
    }
    std::vector<report::Scalar> results;
    try {
        results = possible_results(read_deck(test->deck, file));
    } catch (const input::InputError&) {
        return; // said elsewhere
    }
    const auto result = std::find_if(results.begin(), results.end(), [&](const auto& r) { return r.name == t.result; });
    if (result == results.end()) {
        std::vector<std::string> names;
        for (const auto& r : results) {
            names.push_back(r.name);
        }
        const std::string near = input::nearest(t.result, names);
        problems.push_back({file, at + "/result", "\"" + t.result + "\"",
                            fmt::format("a result of a {} test: {}", input::text_at(test->deck, "test"), fmt::join(names, ", ")),
                            near.empty() ? "" : "did you mean \"" + near + "\"?"});
        return;
    }
    if (said("/value")) {
        return;
    }
    const auto dimension = input::dimension_of(result->unit);
    const std::string value = input::text_at(written, "value");
    if (!value.empty() && dimension) {
        if (const auto quantity = input::parse_quantity(value, *dimension); !quantity.problem.empty()) {
            problems.push_back(
                {file, at + "/value", "\"" + value + "\"",
                 fmt::format("a {}, which is {}", t.result, result->unit.empty() ? "a number without a unit" : "in " + result->unit),
                 quantity.problem});
            return;
        }
    }
    if (t.value < 0.0 && !may_be_negative(t.result)) {
        problems.push_back({file, at + "/value", value.empty() ? fmt::format("{:.6g}", t.value) : "\"" + value + "\"",
                            fmt::format("a positive {}: results are in the sense of the test", t.result), ""});
        return;
    }
    if (t.result.find("slope") != std::string::npos && t.value > 0.0) {
        problems.push_back(
            {file, at + "/value", fmt::format("{:.6g} Pa", t.value), fmt::format("a negative {}: stress falls", t.result), ""});
        return;
    }
    const auto range = plausible_result(*result, input::text_at(test->deck, "test"));
    const double size = std::fabs(t.value);
    const bool wide = t.result == "poisson_ratio" && size < 1.0; // no per cent, and none of a material
    if (range && !range->holds(size)) {
        const std::string si = result->unit.empty() ? "" : " " + result->unit;
        std::string hint;
        if (const auto factor = range->factor_for(size); factor && !wide) {
            const double meant = *factor * t.value;
            hint = fmt::format("did you mean {}?", result->unit.empty() ? fmt::format("{:.6g}", meant)
                                                                        : "\"" + input::format_quantity(meant, *dimension) + "\"");
        }
        problems.push_back({file, at + "/value", fmt::format("{:.6g}{}", t.value, si),
                            fmt::format("a {} of {:.3g} to {:.3g}{}, as materials have it", t.result, range->low, range->high, si), hint});
        return;
    }
    if (const std::string wrong = against_deck(t, test->deck, result->unit); !wrong.empty()) {
        problems.push_back({file, at + "/value", value.empty() ? fmt::format("{:.6g}", t.value) : "\"" + value + "\"", wrong, ""});
    }
}

} // namespace proveta
