// Convergence of the uniaxial test in sphere size, time step and loading rate (thesis 5.4.4, figures 5.23 to 5.25).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/derived.hpp"
#include "lab/test_run.hpp"
#include "lab/verification/brittle.hpp"
#include "lab/verification/cases.hpp"

namespace proveta::verification {

namespace convergence_case {

struct Test {
    double peak = 0.0;    // Pa
    double strain = 0.0;  // at the peak
    double modulus = 0.0; // Pa, from the platens
    double drop = 0.0;    // strain in which the stress falls from 90 % to 60 % of the peak, past it
    double step = 0.0;    // s
    report::Curve curve;
};

Test press(const input::Json& changes, const std::string& name, const char* colour) {
    input::Json json = {
        {"test", "ucs"}, {"material", brittle_concrete()}, {"loading", {{"stop", {{"axial_strain", 0.006}, {"post_peak_drop", 0.5}}}}}};
    json.merge_patch(changes);
    const Deck deck = read_deck(json, "convergence");
    Bench bench = set_up(deck, make_specimen(deck.specimen));
    const TestData data = run_protocol(deck, bench, {[](const TestData&, double) {}, [] {}, [] { return false; }});
    const auto strain = data.curve.values("axial_strain");
    const auto stress = data.curve.values("axial_stress");
    const std::size_t peak = peak_index(stress);
    Test out;
    out.peak = stress[peak];
    out.strain = strain[peak];
    out.modulus = slope_between(strain, stress, 0.1, 1.0 / 3.0).value_or(0.0);
    out.step = bench.model->first_dt();
    out.curve = {name, {}, {}, colour};
    double at90 = 0.0;
    double at60 = 0.0;
    for (std::size_t k = 0; k < strain.size(); ++k) {
        out.curve.x.push_back(100.0 * strain[k]);
        out.curve.y.push_back(1e-6 * stress[k]);
        if (k > peak) {
            at90 = at90 == 0.0 && stress[k] < 0.9 * out.peak ? strain[k] : at90;
            at60 = at60 == 0.0 && stress[k] < 0.6 * out.peak ? strain[k] : at60;
        }
    }
    out.drop = at60 - at90;
    return out;
}

constexpr const char* colours[] = {"#9aa5b1", "#0e8a93", "#1e7b46", "#b9770e", "#7d3c98", "#1f4e79", "#c0392b"};

report::Plot plot_of(const char* title) { return {title, "axial strain [%]", "axial stress [MPa]", {}, {}}; }

} // namespace convergence_case

Case mesh_convergence() {
    using namespace convergence_case;
    return {
        "mesh-convergence", "5.4.4", "The default test on 107 to 71,852 spheres, softening by ratio as the thesis and by fracture energy.",
        true, [] {
            Outcome out;
            for (const bool by_energy : {false, true}) {
                const char* how = by_energy ? "by fracture energy" : "by ratio";
                report::Plot plot = plot_of(by_energy ? "Number of spheres, softening by fracture energy."
                                                      : "Number of spheres, softening by ratio (fig. 5.23).");
                std::vector<double> peaks;
                int k = 0;
                for (const int n : {107, 251, 497, 1004, 4959, 13500, 71852}) {
                    if (by_energy && n > 20000) {
                        continue; // tough to the end of the strain range: an hour
                    }
                    input::Json json = {{"specimen", {{"spheres", n}}}, {"loading", {{"rate", 0.1}}}};
                    if (by_energy) {
                        // Enough that the coarsest specimen's bonds, some 60 mm long, do not snap back; then much tougher than concrete.
                        json["material"] = {{"card", "custom"}, {"fracture_energy_tension", 120.0}, {"fracture_energy_shear", 3000.0}};
                    }
                    const Test t = press(json, fmt::format("{} spheres", n), colours[k++]);
                    out.checks.push_back({fmt::format("peak, {} spheres, {}", n, how), 0.0, 1e-6 * t.peak, 0.0, Compare::reported, "MPa"});
                    peaks.push_back(t.peak);
                    plot.curves.push_back(t.curve);
                }
                const auto [low, high] = std::minmax_element(peaks.begin() + 4, peaks.end());
                out.checks.push_back({fmt::format("spread of the peak from 4,959 spheres on, {}", how), 0.0, *high / *low - 1.0, 0.0,
                                      Compare::reported, ""});
                out.plots.push_back(plot);
            }
            return out;
        }};
}

Case step_convergence() {
    using namespace convergence_case;
    return {"step-convergence", "5.4.4", "The same test at time steps from a tenth of the default to above the stable one.", true, [] {
                Outcome out;
                report::Plot plot = plot_of("Time step (fig. 5.24).");
                const input::Json base = {{"specimen", {{"spheres", 2000}}}, {"loading", {{"rate", 0.2}}}};
                const Test whole = press(base, "0.9 of the stable step", colours[5]);
                plot.curves.push_back(whole.curve);
                int k = 0;
                for (const double share : {0.1, 0.3, 0.6}) {
                    input::Json json = base;
                    json["numerics"]["time_step"] = share / 0.9 * whole.step;
                    const Test t = press(json, fmt::format("{} of it", share), colours[k++]);
                    // Below the stable step nothing but round-off's statistics is left: 1 to 2 % in the peak.
                    out.checks.push_back(
                        {fmt::format("modulus at {} of the stable step", share), whole.modulus, t.modulus, 1e-3, Compare::relative, "Pa"});
                    out.checks.push_back(
                        {fmt::format("peak at {} of the stable step", share), whole.peak, t.peak, 0.03, Compare::relative, "Pa"});
                    plot.curves.push_back(t.curve);
                }
                double refused = 0.0;
                try {
                    input::Json json = base;
                    json["numerics"]["time_step"] = 1.05 / 0.9 * whole.step;
                    press(json, "above", colours[0]);
                } catch (const input::InputError&) {
                    refused = 1.0;
                }
                out.checks.push_back(
                    {"a step 5 % above the stable one is refused", 1.0, refused, 0.0, Compare::absolute, "", "unstable at 5e-7 of 6e-7 s"});
                out.plots.push_back(plot);
                return out;
            }};
}

Case rate_convergence() {
    using namespace convergence_case;
    return {
        "rate-convergence", "5.4.4", "The same test at closing speeds from 0.02 to 2 m/s.", true, [] {
            Outcome out;
            report::Plot plot = plot_of("Loading rate (fig. 5.25).");
            std::vector<Test> tests;
            for (const double rate : {0.02, 0.1, 0.5, 2.0}) {
                tests.push_back(press({{"specimen", {{"spheres", 4000}}}, {"loading", {{"rate", rate}}}}, fmt::format("{} m/s", rate),
                                      colours[3 + tests.size()]));
                plot.curves.push_back(tests.back().curve);
                out.checks.push_back({fmt::format("peak at {} m/s", rate), 0.0, 1e-6 * tests.back().peak, 0.0, Compare::reported, "MPa"});
                out.checks.push_back({fmt::format("strain from 90 % to 60 % past the peak at {} m/s", rate), 0.0, 100.0 * tests.back().drop,
                                      0.0, Compare::reported, "%"});
            }
            out.checks.push_back({"elastic part: modulus at 2 m/s over that at 0.02 m/s", 1.0, tests[3].modulus / tests[0].modulus, 0.1,
                                  Compare::relative, ""});
            out.checks.push_back(
                {"higher when fast: peak at 2 m/s over that at 0.02 m/s", 1.05, tests[3].peak / tests[0].peak, 0.0, Compare::at_least, ""});
            out.checks.push_back(
                {"ductile when fast: fall at 2 m/s over that at 0.02 m/s", 2.0, tests[3].drop / tests[0].drop, 0.0, Compare::at_least, ""});
            out.checks.push_back({"slow is converged: peak at 0.1 m/s over that at 0.02 m/s", 1.0, tests[1].peak / tests[0].peak, 0.05,
                                  Compare::relative, ""});
            out.plots.push_back(plot);
            return out;
        }};
}

} // namespace proveta::verification
