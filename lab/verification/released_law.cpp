// The released DEMpack law on two spheres, against the released code's own answers.
//
// Answers: Kratos Multiphysics, DEMApplication, benchmarks 20 to 25 (two spheres of radius 1 m, E = 1 GPa, nu = 0.2, law DEM_Dempack);
// forces and times read from its reference curves. 20 and 21 compression, 22 and 23 tension, 24 and 25 shear; distance 2 m, in 21 and
// 23 1.95 m.
#include <cmath>
#include <numbers>

#include "core/laws/bond_laws.hpp"
#include "lab/verification/cases.hpp"

namespace proveta::verification {

namespace released_law_case {

struct Pair {
    KratosDempack::Constants law;
    double length = 2.0;
    double area = std::numbers::pi;
    KratosDempack::State<double> state{{0, 0, 0}, 0, 0, 0};
    BondResponse<double> response{};
    double shortening = 0.0;

    explicit Pair(double distance) : length(distance) {
        law.shear_ratio = 1.0 / 2.4;
        law.sigma_f = 1e6;
        law.tau_f = 0.5e6;
        law.mu_s = 1.0;
        law.softening_n = 0.8;
        law.shear_energy = 1.0;
        for (double& ratio : law.yrc) {
            ratio = 1.0;
        }
    }
    [[nodiscard]] double k_n() const { return 1e9 * area / length; }
    void move(double approach, double slip) {
        shortening += approach;
        response = KratosDempack::advance<double>(law, {k_n(), area, length, 0.0, 1.0}, {shortening, approach, {slip, 0, 0}}, state);
    }
};

constexpr double step = 1e-6; // m: 0.1 m/s for 1e-5 s

void compression(Outcome& out, const char* name, double distance, double slope) {
    Pair pair(distance);
    for (int k = 0; k < 1000; ++k) {
        pair.move(step, 0.0);
    }
    out.checks.push_back(
        {std::string(name) + " compression, slope", slope, pair.response.normal / (1000 * step), 0.02, Compare::relative, "N/m"});
}

void tension(Outcome& out, report::Curve& curve, const char* name, double distance, double slope, double end) {
    Pair pair(distance);
    double peak = 0.0;
    double gone = 0.0;
    double first = 0.0;
    for (int k = 1; k <= 5000; ++k) {
        pair.move(-step, 0.0);
        const double pull = -pair.response.normal;
        first = k == 100 ? pull / (100 * step) : first;
        peak = std::max(peak, pull);
        gone = pull == 0.0 && gone == 0.0 ? k * step : gone;
        if (k % 20 == 0) {
            curve.x.push_back(1e3 * k * step);
            curve.y.push_back(1e-6 * pull);
        }
    }
    out.checks.push_back({std::string(name) + " tension, slope", slope, first, 0.02, Compare::relative, "N/m"});
    out.checks.push_back({std::string(name) + " tension, peak", 3.14159e6, peak, 0.02, Compare::relative, "N"});
    out.checks.push_back({std::string(name) + " tension, opening at failure", end, gone, 0.02, Compare::relative, "m"});
}

// The spheres slide by 1.2566e-5 m a step, which follows from the reference's first force, 8,224.67 N, and k_t; in 25 a compression of
// 157,466 N comes on in step 380.
void shear(Outcome& out, report::Curve& curve, const char* name, bool pressed) {
    Pair pair(2.0);
    constexpr double slip = 8224.67 / (1e9 / 2.4 * std::numbers::pi / 2.0);
    double peak = 0.0;
    double late = 0.0;
    int gone = 0;
    std::vector<double> force;
    for (int k = 1; k <= 500; ++k) {
        pair.move(pressed && k == 380 ? 157466.0 / pair.k_n() : 0.0, slip);
        force.push_back(pair.response.shear[0]);
        peak = std::max(peak, force.back());
        gone = force.back() <= 0.0 && gone == 0 ? k : gone;
        late = k == 385 ? force.back() : late;
        curve.x.push_back(1e3 * k * slip);
        curve.y.push_back(1e-6 * force.back());
    }
    out.checks.push_back({std::string(name) + " shear, peak", 1.56269e6, peak, 0.02, Compare::relative, "N"});
    out.checks.push_back(
        {std::string(name) + " shear, softening a step", -8224.67, (force[299] - force[199]) / 100, 0.02, Compare::relative, "N"});
    if (pressed) {
        out.checks.push_back({std::string(name) + " shear after pressure came on, step 385", 123757, late, 0.1, Compare::relative, "N"});
    } else {
        out.checks.push_back(
            {std::string(name) + " shear, force left after failure", -115.707, force.back(), 0.02, Compare::relative, "N"});
        out.checks.push_back({std::string(name) + " shear, steps to failure", 381, static_cast<double>(gone), 0.02, Compare::relative, ""});
    }
}

} // namespace released_law_case

Case released_law() {
    using namespace released_law_case;
    return {"released-law", "5.2 (as released)", "The bond law of the released DEMpack code on two spheres, against that code's answers.",
            false, [] {
                Outcome out;
                report::Curve pulled{"22 tension", {}, {}, "#1f4e79"};
                report::Curve closer{"23 tension, d = 1.95 m", {}, {}, "#1e7b46"};
                report::Curve sheared{"24 shear", {}, {}, "#c0392b"};
                report::Curve pressed{"25 shear, pressed late", {}, {}, "#b9770e"};
                compression(out, "20", 2.0, 1.5708e9);
                compression(out, "21", 1.95, 1.61107e9);
                tension(out, pulled, "22", 2.0, 1.5708e9, 3.6e-3);
                tension(out, closer, "23", 1.95, 1.61107e9, 3.51e-3);
                shear(out, sheared, "24", false);
                shear(out, pressed, "25", true);
                out.plots.push_back(
                    {"Two spheres under the released law.", "displacement [mm]", "force [MN]", {pulled, closer, sheared, pressed}, {}});
                out.notes.emplace_back(
                    "The pressure of 25 comes on while the bond is one step from failure: its force then is the small difference of two "
                    "large numbers, one step of slip being 5 % of it; hence 10 % there.");
                return out;
            }};
}

} // namespace proveta::verification
