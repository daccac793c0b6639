// A bond that has failed is a contact: bond of no strength against no bond.
#include <algorithm>
#include <cmath>

#include "core/model.hpp"
#include "lab/verification/cases.hpp"
#include "lab/verification/unbreakable.hpp"

namespace proveta::verification {

namespace weak_equals_none_case {

// Two spheres that touch at rest, driven apart for a little and then into each other at a slant, with spin: sticking, sliding, parting.
std::vector<Vec3> path(bool bonded, double mu) {
    Material m = unbreakable(); // the loose law has no plastic branch
    m.as<Dempack>().sigma_f = 0.0;
    m.as<Dempack>().tau_f = 0.0;
    m.mu_d = mu;
    m.contact_restitution = 1.0; // nor the failed bond a dashpot
    Spheres s;
    s.add({0, 0, 0}, 0.01, 2500.0);
    s.add({0.025, 0, 0}, 0.015, 2500.0);
    std::vector<double> weight;
    std::vector<proveta::Pair> pairs;
    if (bonded) {
        pairs.push_back({0, 1});
    }
    Bonds bonds = make_bonds(s, {m}, pairs, {0, 0}, weight);
    if (!bonded) {
        // Of a lone pair without bonds the area weights are 1; the bond's own are what a later contact in a specimen would get.
        make_bonds(s, {m}, {{0, 1}}, {0, 0}, weight);
    }
    s.velocity.set(0, {-0.1, 0, 0});
    s.velocity.set(1, {0.1, 0, 0});
    Numerics numerics;
    numerics.damping = {0.0, 0.0};
    numerics.time_step = 1e-7;
    Model model(s, {m}, bonds, weight, {}, numerics);
    std::vector<Vec3> out;
    for (int k = 0; k < 8000; ++k) {
        if (k == 50) {
            model.spheres.velocity.set(0, {0.8, 0.3, 0.1});
            model.spheres.velocity.set(1, {-0.5, -0.2, 0.0});
            model.spheres.spin.set(0, {3.0, -20.0, 11.0});
            model.spheres.spin.set(1, {-7.0, 5.0, 30.0});
        }
        model.step({}, false);
        if (k < 400 || k % 20 == 0) {
            out.push_back(model.spheres.position.at(1) - model.spheres.position.at(0));
            out.push_back(model.spheres.velocity.at(0));
            out.push_back(model.spheres.spin.at(1));
        }
    }
    return out;
}

} // namespace weak_equals_none_case

Case weak_equals_none() {
    using namespace weak_equals_none_case;
    return {"weak-equals-none", "5.2.5", "A bond of no strength, once pulled, moves like a pair that was never bonded.", false, [] {
                Outcome out;
                for (const double mu : {0.0, 0.25, 1.0}) {
                    const auto weak = path(true, mu);
                    const auto none = path(false, mu);
                    double difference[3] = {0.0, 0.0, 0.0};
                    double size[3] = {0.0, 0.0, 0.0};
                    report::Curve a{"bond of no strength", {}, {}, "#1f4e79"};
                    report::Curve b{"no bond", {}, {}, "#c0392b"};
                    for (std::size_t k = 0; k < weak.size(); ++k) {
                        difference[k % 3] = std::max(difference[k % 3], (weak[k] - none[k]).norm());
                        size[k % 3] = std::max(size[k % 3], none[k].norm());
                        if (k % 3 == 1) {
                            if (a.x.size() < 400) { // the contact, a step a sample
                                a.x.push_back(0.1 * static_cast<double>(a.x.size()));
                                a.y.push_back(weak[k].x());
                                b.x.push_back(a.x.back());
                                b.y.push_back(none[k].x());
                            }
                        }
                    }
                    const char* what[3] = {"relative position", "velocity", "spin"};
                    for (int q = 0; q < 3; ++q) {
                        // Round-off of some thousand steps; both sides run the same formulas on the same numbers.
                        out.checks.push_back({std::string("largest difference in ") + what[q] + ", mu " + std::to_string(mu).substr(0, 4),
                                              0.0, difference[q] / size[q], 1e-10, Compare::absolute, ""});
                    }
                    if (mu == 0.25) {
                        out.plots.push_back({"An oblique impact with and without a failed bond.",
                                             "time [us]",
                                             "velocity along the first line of centres [m/s]",
                                             {a, b},
                                             {}});
                    }
                }
                return out;
            }};
}

} // namespace proveta::verification
