// Mass scaling: what it may add, what it gains, and that the bound holds.
#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>

#include "core/statics/bond_network.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

double sum(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

// A specimen without platens or contacts, at rest, to be shaken at a given step.
Model bare(const Bench& bench, double dt, double scaling, double alpha = 0.0) {
    Numerics numerics;
    numerics.time_step = dt;
    numerics.refuse_unstable = false;
    numerics.damping = {alpha, alpha};
    numerics.mass_scaling = scaling;
    Spheres s = bench.model->spheres;
    if (!bench.model->mass_scaling().mass.empty()) {
        s.mass = bench.model->mass_scaling().mass;
    }
    return {s, bench.model->materials, bench.model->bonds, std::vector<double>(s.size(), 1.0), {}, numerics};
}

// Largest speed over the one it began with, after some steps of free vibration.
double growth(Model model, int steps) {
    constexpr double speed = 1e-6; // m/s
    for (std::size_t k = 0; k < model.spheres.size(); ++k) {
        const auto x = static_cast<double>(k);
        model.spheres.velocity.set(k, speed * Vec3(std::sin(x), std::sin(2.0 * x + 1.0), std::sin(3.0 * x + 2.0)));
    }
    double fastest = 0.0;
    for (int n = 0; n < steps && fastest < 1e3 * speed; ++n) {
        model.step({}, false);
        fastest = 0.0;
        for (std::size_t k = 0; k < model.spheres.size(); ++k) {
            fastest = std::max(fastest, model.spheres.velocity.at(k).norm());
        }
    }
    return fastest / speed;
}

} // namespace

TEST_CASE("mass-scaling: the added mass stays within its share and the stable step grows") {
    const std::string off = R"({"numerics": {"mass_scaling": 0}})";
    const Deck plain = small_deck(1500, off);
    const Specimen specimen = make_specimen(plain.specimen);
    const Bench without = set_up(plain, specimen);
    CHECK(without.model->mass_scaling().spheres == 0);
    CHECK(without.model->mass_scaling().step_after == without.model->stable_step());
    double last = without.model->stable_step();
    for (const double share : {0.01, 0.05, 0.2}) {
        const Deck deck = small_deck(1500, R"({"numerics": {"mass_scaling": )" + std::to_string(share) + "}}");
        const Bench bench = set_up(deck, specimen);
        const MassScaling& scaling = bench.model->mass_scaling();
        const double added = sum(bench.model->spheres.mass) / sum(without.model->spheres.mass) - 1.0;
        CHECK(scaling.mass == without.model->spheres.mass);
        CHECK(added <= share * (1 + 1e-9));
        CHECK(added >= 0.5 * share);
        CHECK(scaling.added == Approx(added));
        CHECK(scaling.step_before == without.model->stable_step());
        CHECK(bench.model->stable_step() > 1.05 * last);
        last = bench.model->stable_step();
        std::size_t heavier = 0;
        for (std::size_t k = 0; k < bench.model->spheres.size(); ++k) {
            const double factor = bench.model->spheres.mass[k] / without.model->spheres.mass[k];
            heavier += factor > 1.0 ? 1 : 0;
            REQUIRE(factor >= 1.0);
            REQUIRE(factor <= scaling.largest_factor * (1 + 1e-12));
            REQUIRE(bench.model->spheres.inertia[k] == Approx(factor * without.model->spheres.inertia[k]));
        }
        CHECK(heavier == scaling.spheres);
    }
}

TEST_CASE("mass-scaling: the bound stays below the power iteration's limit, and a step beyond the true masses' limit is stable") {
    const Deck deck =
        small_deck(600, R"({"numerics": {"mass_scaling": 0.1}, "material": {"card": "custom", "sigma_f": "100 GPa", "tau_f": "100 GPa"}})");
    const Specimen specimen = make_specimen(deck.specimen);
    const Bench bench = set_up(deck, specimen);
    const Model& m = *bench.model;
    const double scaled = 2.0 / std::sqrt(largest_eigenvalue(m.spheres, m.bonds, 2000));
    CHECK(m.stable_step() <= scaled * (1 + 1e-6));
    const Bench without = set_up(small_deck(600, R"({"numerics": {"mass_scaling": 0}})"), specimen);
    const double critical = 2.0 / std::sqrt(largest_eigenvalue(without.model->spheres, without.model->bonds, 2000));
    const double dt = 1.03 * critical;
    REQUIRE(dt < m.stable_step());
    CHECK(growth(bare(without, dt, 0.0), 4000) > 1e3);
    CHECK(growth(bare(without, dt, 0.1), 4000) < 20.0);
}

TEST_CASE("stable step: strong non-viscous damping lowers the bound, below which motion dies out and above which it does not") {
    const Deck deck = small_deck(
        600,
        R"({"material": {"card": "custom", "elasticity": "as-given", "sigma_f": "100 GPa", "tau_f": "100 GPa"}, "numerics": {"mass_scaling": 0}})");
    const Specimen specimen = make_specimen(deck.specimen);
    const Bench bench = set_up(deck, specimen);
    const double bound = bare(bench, 1e-9, 0.0).stable_step(); // of the springs alone
    for (const double alpha : {0.2, 0.5, 0.8}) {
        const double stable = bound / std::sqrt(1.0 + alpha);
        CHECK(bare(bench, 0.99 * stable, 0.0, alpha).stable_step() == Approx(stable).epsilon(1e-3));
        CHECK(growth(bare(bench, 0.99 * stable, 0.0, alpha), 8000) < 1e-2); // the slowest mode of a specimen decides
        CHECK(growth(bare(bench, 1.03 * stable, 0.0, alpha), 4000) > 0.1);
    }
}

TEST_CASE("mass-scaling: weight stays that of the true mass") {
    const Deck deck = small_deck(300, R"({"numerics": {"mass_scaling": 0}})");
    const Bench bench = set_up(deck, make_specimen(deck.specimen));
    Numerics numerics;
    numerics.mass_scaling = 0.2;
    numerics.gravity = {0, 0, -9.81};
    numerics.damping = {0.0, 0.0};
    Model model(bench.model->spheres, bench.model->materials, bench.model->bonds, std::vector<double>(300, 1.0), {}, numerics);
    REQUIRE(model.mass_scaling().spheres > 0);
    for (int n = 0; n < 50; ++n) {
        model.step({}, true);
    }
    double momentum = 0.0; // half a step behind
    for (std::size_t k = 0; k < model.spheres.size(); ++k) {
        momentum += model.spheres.mass[k] * model.spheres.velocity.z[k];
    }
    CHECK(momentum == Approx(-9.81 * 49.5 * model.dt() * sum(bench.model->spheres.mass)).epsilon(1e-9));
    CHECK(std::fabs(model.ledger().relative_residual()) < 0.01);
}
