// The linear elastic solve against closed forms.
#include <catch2/catch.hpp>

#include <cmath>
#include <omp.h>

#include "core/statics/elastic.hpp"
#include "lab/elastic_press.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

// n spheres of radius r in a row along x, bonded, with the given k_t / k_n.
struct Chain {
    Spheres spheres;
    Bonds bonds;

    Chain(std::size_t n, double r, double ratio, bool planar = false) {
        spheres.planar = planar;
        std::vector<Pair> pairs;
        for (std::size_t k = 0; k < n; ++k) {
            spheres.add({2.0 * r * static_cast<double>(k), 0, 0}, r, 2500.0);
            if (k > 0) {
                pairs.push_back({static_cast<std::int32_t>(k - 1), static_cast<std::int32_t>(k)});
            }
        }
        Material m = unbreakable();
        m.area_rule = AreaRule::truncated_cone;
        m.shear_factor = ratio * 2.0 * (1.0 + m.poisson_ratio);
        std::vector<double> weight;
        bonds = make_bonds(spheres, {m}, pairs, std::vector<std::uint8_t>(n, 0), weight);
    }
};

} // namespace

TEST_CASE("elastic: a chain of spheres is springs in series, along and across") {
    for (const bool planar : {false, true}) {
        const std::size_t n = 7;
        const double r = 0.004;
        const double ratio = 0.3;
        const Chain chain(n, r, ratio, planar);
        const double k_n = chain.bonds.stiffness[0];
        // Free to roll a chain is a mechanism: hold all rotations.
        std::vector<Support> held;
        for (std::size_t k = 0; k < n; ++k) {
            held.push_back({k, 4, 0.0});
            if (!planar) {
                held.insert(held.end(), {{k, 1, 0.0}, {k, 3, 0.0}, {k, 5, 0.0}});
            }
        }
        auto tension = held;
        tension.insert(tension.end(), {{0, 0, 0.0}, {0, 2, 0.0}, {n - 1, 0, 1e-6}});
        const auto pulled = solve_elastic(chain.spheres, chain.bonds, tension);
        CHECK(pulled.iterations == 0);
        CHECK(pulled.force.x[n - 1] == Approx(k_n * 1e-6 / 6.0).epsilon(1e-12));
        CHECK(pulled.force.x[0] == Approx(-k_n * 1e-6 / 6.0).epsilon(1e-12));
        CHECK(pulled.energy == Approx(0.5 * k_n / 6.0 * 1e-12).epsilon(1e-12));
        for (std::size_t k = 0; k < n; ++k) {
            CHECK(pulled.displacement.x[k] == Approx(1e-6 * static_cast<double>(k) / 6.0).epsilon(1e-12));
        }

        auto sheared = held;
        sheared.insert(sheared.end(), {{0, 0, 0.0}, {0, 2, 0.0}, {n - 1, 2, 1e-6}});
        const auto across = solve_elastic(chain.spheres, chain.bonds, sheared);
        CHECK(across.force.z[n - 1] == Approx(ratio * k_n * 1e-6 / 6.0).epsilon(1e-12));
        // The force at one end over the chain's length is held by the moments on the spheres.
        double moment = 0.0;
        for (std::size_t k = 0; k < n; ++k) {
            moment += across.moment.y[k];
        }
        const double lever = chain.spheres.position.x[n - 1];
        CHECK(moment == Approx(lever * across.force.z[n - 1]).epsilon(1e-12));
    }
}

TEST_CASE("elastic: rigid motion costs nothing; free rotation turns shear into rolling") {
    const Chain chain(2, 0.004, 0.4);
    // One end turns about y by w, the other follows: rel = u_j - (l_i w_i + l_j w_j) x n = 0 with both turning and moving.
    std::vector<Support> turned{{0, 0, 0.0}, {0, 1, 0.0}, {0, 2, 0.0},  {0, 3, 0.0}, {0, 4, 1e-3},
                                {0, 5, 0.0}, {1, 3, 0.0}, {1, 4, 1e-3}, {1, 5, 0.0}};
    const auto rigid = solve_elastic(chain.spheres, chain.bonds, turned);
    CHECK(rigid.displacement.z[1] == Approx(-1e-3 * 0.008).epsilon(1e-12));
    CHECK(rigid.energy == Approx(0.0).margin(1e-18 * chain.bonds.stiffness[0]));
    // The second sphere free to turn: shearing the pair only makes it roll.
    const std::vector<Support> rolling{{0, 0, 0.0}, {0, 1, 0.0}, {0, 2, 0.0}, {0, 3, 0.0}, {0, 4, 0.0},
                                       {0, 5, 0.0}, {1, 0, 0.0}, {1, 1, 0.0}, {1, 2, 1e-6}};
    const auto rolled = solve_elastic(chain.spheres, chain.bonds, rolling);
    CHECK(std::fabs(rolled.force.z[1]) < 1e-9 * chain.bonds.stiffness[0] * 1e-6);
    CHECK(std::fabs(rolled.rotation.y[1]) == Approx(1e-6 / 0.004).epsilon(1e-9));
}

TEST_CASE("elastic: what is not held is refused, rattlers and springless rotations are not") {
    const Chain chain(3, 0.004, 0.0);
    CHECK_THROWS_AS(solve_elastic(chain.spheres, chain.bonds, {{3, 0, 0.0}}), std::invalid_argument);
    CHECK_THROWS_AS(solve_elastic(chain.spheres, chain.bonds, {{0, 6, 0.0}}), std::invalid_argument);
    const auto free = solve_elastic(chain.spheres, chain.bonds, {{0, 0, 0.0}, {2, 0, 2e-6}});
    CHECK(free.displacement.x[1] == Approx(1e-6));
    const Chain stiff(3, 0.004, 0.5);
    CHECK_THROWS_AS(solve_elastic(stiff.spheres, stiff.bonds, {{0, 2, 1.0}}), NotSolvable);
    const Chain flat(2, 0.004, 0.5, true);
    CHECK_THROWS_AS(solve_elastic(flat.spheres, flat.bonds, {{0, 1, 0.0}}), std::invalid_argument);
}

TEST_CASE("elastic: both solvers agree, on any number of threads, and with the dynamic press") {
    const Deck deck = small_deck(400);
    const Bench bench = set_up(deck, make_specimen(deck.specimen));
    const Model& m = *bench.model;
    ElasticOptions direct;
    direct.direct_in_space = 1000000;
    ElasticOptions iterative;
    iterative.direct_in_space = 0;
    const auto a = press_elastically(bench.specimen.shape, m.spheres, m.bonds, direct);
    const auto b = press_elastically(bench.specimen.shape, m.spheres, m.bonds, iterative);
    CHECK(a.iterations == 0);
    CHECK(b.iterations > 0);
    CHECK(a.young_modulus == Approx(b.young_modulus).epsilon(1e-7));
    CHECK(a.poisson_ratio == Approx(b.poisson_ratio).epsilon(1e-6));
    const int threads = omp_get_max_threads();
    omp_set_num_threads(3);
    const auto c = press_elastically(bench.specimen.shape, m.spheres, m.bonds, iterative);
    omp_set_num_threads(threads);
    CHECK(b.young_modulus == c.young_modulus);
    CHECK(b.poisson_ratio == c.poisson_ratio);
}
