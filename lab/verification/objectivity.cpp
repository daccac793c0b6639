// The same calculation translated, turned, renumbered and on another number of threads.
#include <omp.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/model.hpp"
#include "lab/verification/cases.hpp"
#include "specimens/packing.hpp"
#include "specimens/random.hpp"

namespace proveta::verification {

namespace objectivity_case {

struct View {
    Mat3 turn = Mat3::Identity();
    Vec3 shift = Vec3::Zero();
    bool reversed = false;
};

struct End {
    std::vector<Vec3> place; // of each sphere by its id, turned and shifted back
    Ledger ledger;
    double broken = 0.0;
    std::uint64_t hash = 0;
    report::Curve failed; // bonds over time
};

// A free ball-like cluster of bonded spheres flung apart by a random field of velocities of the given size.
End fling(const Packing& packing, const View& view, double speed, int steps) {
    Material m;
    const std::size_t n = packing.radius.size();
    Random random(7, Stream::positions);
    std::vector<Vec3> velocity(n);
    for (auto& v : velocity) {
        v = speed * Vec3(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5);
    }
    Spheres s;
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t from = view.reversed ? n - 1 - k : k;
        s.add(view.turn * packing.centre.at(from) + view.shift, packing.radius[from], 2500.0);
        s.velocity.set(k, view.turn * velocity[from]);
        s.id.back() = static_cast<std::int64_t>(from);
    }
    double beta = 0.0;
    const auto pairs = bonded_pairs(s, {0.15, 0.0}, beta);
    std::vector<double> weight;
    Bonds bonds = make_bonds(s, {m}, pairs, std::vector<std::uint8_t>(n, 0), weight);
    Numerics numerics;
    numerics.time_step = 2e-7;
    Model model(s, {m}, bonds, weight, {}, numerics);
    End out;
    for (int k = 0; k < steps; ++k) {
        model.step({}, k + 1 == steps);
        if (k % 10 == 0) {
            out.failed.x.push_back(1e6 * model.time());
            out.failed.y.push_back(static_cast<double>(model.broken()));
        }
    }
    out.place.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
        out.place[static_cast<std::size_t>(model.spheres.id[k])] = view.turn.transpose() * (model.spheres.position.at(k) - view.shift);
    }
    out.ledger = model.ledger();
    out.broken = static_cast<double>(model.broken());
    out.hash = model.state_hash();
    return out;
}

} // namespace objectivity_case

Case objectivity() {
    using namespace objectivity_case;
    return {
        "objectivity", "-", "The same cluster translated, turned by a random rotation, renumbered, and on 1 and 3 threads.", false, [] {
            Outcome out;
            Shape box;
            box.kind = ShapeKind::prism;
            box.width = box.depth = box.height = 0.1;
            std::vector<double> radii(1200, 0.00515);
            for (std::size_t k = 0; k < radii.size(); ++k) {
                radii[k] *= 0.8 + 0.4 * static_cast<double>(k % 17) / 16.0;
            }
            Relaxation report;
            const Packing packing = pack(box, radii, 3, 0.05, report);
            View turned;
            turned.turn = Eigen::Quaterniond(0.3, -0.7, 0.5, 0.41).normalized().toRotationMatrix();
            View shifted;
            shifted.shift = {0.3, -0.2, 0.5};
            View reversed;
            reversed.reversed = true;
            View all = turned;
            all.shift = shifted.shift;
            all.reversed = true;

            const End base = fling(packing, {}, 0.5, 400);
            double moved = 0.0;
            for (std::size_t k = 0; k < base.place.size(); ++k) {
                moved = std::max(moved, (base.place[k] - packing.centre.at(k)).norm());
            }
            out.checks.push_back({"gentle: bonds failed", 0.0, base.broken, 0.0, Compare::absolute, ""});
            for (const auto& [name, view] :
                 {std::pair{"translated", shifted}, {"turned", turned}, {"renumbered", reversed}, {"all three", all}}) {
                const End end = fling(packing, view, 0.5, 400);
                double worst = 0.0;
                for (std::size_t k = 0; k < base.place.size(); ++k) {
                    worst = std::max(worst, (end.place[k] - base.place[k]).norm());
                }
                // Round-off of coordinates of 0.5 m (1e-16 m) against displacements of micrometres, through 400 steps.
                out.checks.push_back({std::string("gentle, ") + name + ": largest difference over the largest displacement", 0.0,
                                      worst / moved, 1e-7, Compare::absolute, ""});
                out.checks.push_back({std::string("gentle, ") + name + ": elastic energy", base.ledger.elastic, end.ledger.elastic, 1e-8,
                                      Compare::relative, "J"});
            }
            const End violent = fling(packing, {}, 60.0, 1500);
            const End other = fling(packing, all, 60.0, 1500);
            out.checks.push_back({"violent: bonds failed", 500.0, violent.broken, 0.0, Compare::at_least, ""});
            // After failure round-off decides which bond goes first: statistics agree, paths do not.
            out.checks.push_back({"violent, all three: bonds failed", violent.broken, other.broken, 0.03, Compare::relative, ""});
            out.checks.push_back(
                {"violent, all three: damage energy", violent.ledger.damage, other.ledger.damage, 0.03, Compare::relative, "J"});

            report::Plot plot{"Bonds failing in a cluster flung apart.", "time [us]", "failed bonds", {violent.failed, other.failed}, {}};
            plot.curves[0].name = "as it is";
            plot.curves[1].name = "turned, moved and renumbered";
            plot.curves[1].colour = "#c0392b";
            out.plots.push_back(plot);
            const int before = omp_get_max_threads();
            omp_set_num_threads(3);
            const End threads = fling(packing, {}, 60.0, 1500);
            omp_set_num_threads(1);
            const End single = fling(packing, {}, 60.0, 1500);
            omp_set_num_threads(before);
            out.checks.push_back({"1 and 3 threads: same bits of the final state", 1.0, threads.hash == single.hash ? 1.0 : 0.0, 0.0,
                                  Compare::absolute, ""});
            return out;
        }};
}

} // namespace proveta::verification
