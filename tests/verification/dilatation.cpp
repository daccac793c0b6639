// The averaged part of the stress: a potential, its forces, its limits.
#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "core/statics/bond_network.hpp"
#include "lab/test_run.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

constexpr const char* averaged = R"({"material": {"card": "custom", "elasticity": "as-given", "averaged_factor": 2.0, "sigma_f": "1000 GPa",
    "tau_f": "1000 GPa", "lcs": ["1000 GPa", "2000 GPa", "3000 GPa"], "fracture_energy_tension": 0, "fracture_energy_shear": 0}})";

// Every sphere somewhere near its place.
NetworkField<1> some_motion(std::size_t spheres, double size) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> in(-size, size);
    NetworkField<1> q(6 * static_cast<Eigen::Index>(spheres));
    for (Eigen::Index k = 0; k < q.size(); ++k) {
        q[k] = in(random) * (k % 6 < 3 ? 1.0 : 100.0);
    }
    return q;
}

} // namespace

TEST_CASE("averaged stress: theta of a uniform strain is its trace, on the whole") {
    const Deck deck = small_deck(800, averaged);
    Bench bench = set_up(deck, make_specimen(deck.specimen));
    Model& m = *bench.model;
    const Vec3 strain(2e-4, -1e-4, 3e-4);
    for (std::size_t k = 0; k < m.spheres.size(); ++k) {
        m.spheres.position.set(k, m.spheres.start.at(k) + strain.cwiseProduct(m.spheres.start.at(k)));
    }
    measure_elongations(m.spheres, m.bonds, 0, m.bonds.size());
    measure_dilatation(m.bonds, 0, m.spheres.size());
    double sum = 0.0;
    double count = 0.0;
    const Shape::Region inner = bench.specimen.shape.inner(0.6, 0.6);
    for (std::size_t k = 0; k < m.spheres.size(); ++k) {
        if (inner.contains(m.spheres.start.at(k))) { // surrounded
            sum += m.bonds.dilatation.theta[k];
            count += 1.0;
        }
    }
    CHECK(sum / count == Approx(strain.sum()).epsilon(0.02)); // single spheres have uneven bonds
}

TEST_CASE("averaged stress: the network's forces are the slope of its energy, and the model's are the network's") {
    const Deck deck = small_deck(300, averaged);
    Bench bench = set_up(deck, make_specimen(deck.specimen));
    Model& m = *bench.model;
    const BondNetwork network(m.spheres, m.bonds, {}, 1);
    const std::size_t n = m.spheres.size();
    const NetworkField<1> q = some_motion(n, 1e-9);
    NetworkField<1> f;
    NetworkField<1> theta;
    network.apply<1>(q, f, theta);
    // Energy written down again from its definition.
    double energy = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
        energy += 0.5 * m.bonds.dilatation.stiffness[k] * theta[static_cast<Eigen::Index>(k)] * theta[static_cast<Eigen::Index>(k)];
        for (const auto* s = network.begin(k); s != network.end(k); ++s) {
            const auto mine = q.segment<6>(6 * static_cast<Eigen::Index>(k));
            const auto other = q.segment<6>(6 * static_cast<Eigen::Index>(s->other));
            const Vec3 turned = s->arm * mine.tail<3>() + s->other_arm * other.tail<3>();
            const Vec3 stretch = other.head<3>() - mine.head<3>() + s->n.cross(turned);
            const double along = s->n.dot(stretch);
            energy += 0.25 * (s->k_n * along * along + s->k_t * (stretch.squaredNorm() - along * along)); // both sides
        }
    }
    CHECK(0.5 * q.dot(f) == Approx(energy).epsilon(1e-12));
    // The stiffness is symmetric.
    const NetworkField<1> p = some_motion(n, 2e-9).reverse();
    NetworkField<1> g;
    network.apply<1>(p, g, theta);
    CHECK(q.dot(g) == Approx(p.dot(f)).epsilon(1e-10));

    // One step of the model from displaced spheres without velocity: normal forces of the bonds.
    for (std::size_t k = 0; k < n; ++k) {
        m.spheres.position.set(k, m.spheres.start.at(k) + q.segment<3>(6 * static_cast<Eigen::Index>(k)));
    }
    NetworkField<1> translated = q;
    for (std::size_t k = 0; k < n; ++k) {
        translated.segment<3>(6 * static_cast<Eigen::Index>(k) + 3).setZero();
    }
    network.apply<1>(translated, f, theta);
    m.step({0.0, 0.0}, true);
    double worst = 0.0;
    double largest = 0.0;
    for (std::size_t b = 0; b < m.bonds.size(); ++b) {
        const auto i = static_cast<std::size_t>(m.bonds.i[b]);
        const auto j = static_cast<std::size_t>(m.bonds.j[b]);
        const Vec3 normal = (m.spheres.start.at(j) - m.spheres.start.at(i)).normalized();
        const double along =
            normal.dot(translated.segment<3>(6 * static_cast<Eigen::Index>(j)) - translated.segment<3>(6 * static_cast<Eigen::Index>(i)));
        const auto& d = m.bonds.dilatation;
        const double pull = m.bonds.stiffness[b] * along + d.stiffness[i] * d.g_i[b] * theta[static_cast<Eigen::Index>(i)] +
                            d.stiffness[j] * d.g_j[b] * theta[static_cast<Eigen::Index>(j)];
        worst = std::max(worst, std::fabs(pull + m.bonds.normal[b]));
        largest = std::max(largest, std::fabs(pull));
    }
    CHECK(worst < 1e-5 * largest); // displacements of 1e-9 m over bonds of 1 cm, twice differenced
}

TEST_CASE("averaged stress: the bound on the stable step is below the critical one") {
    const Deck deck = small_deck(600, averaged);
    const Bench bench = set_up(deck, make_specimen(deck.specimen));
    const Model& m = *bench.model;
    const double critical = 2.0 / std::sqrt(largest_eigenvalue(m.spheres, m.bonds, 3000)); // with the scaled masses
    CHECK(m.mass_scaling().step_after <= critical);
    CHECK(m.mass_scaling().step_after > 0.4 * critical); // Cauchy-Schwarz over ten bonds is not sharp
}

TEST_CASE("averaged stress: the ledger closes through failure, on any number of threads, and open cracks leave theta alone") {
    const Deck deck = small_deck(800, R"({"material": {"poisson_ratio": 0.4}, "output": {"samples": 100, "fields": 0},
                                          "loading": {"rate": "0.2 m/s", "stop": {"axial_strain": 0.004}}})");
    const Specimen specimen = make_specimen(deck.specimen);
    std::vector<std::uint64_t> hashes;
    for (const int threads : {1, 3}) {
        Bench bench = set_up(deck, specimen);
        REQUIRE(bench.model->bonds.dilatation.active());
        bench.model->set_threads(threads);
        const TestData data = run_protocol(deck, bench, {[](const TestData&, double) {}, [] {}, [] { return false; }});
        CHECK(bench.model->broken() > 100);
        for (const auto& row : data.energy.rows) {
            CHECK(std::fabs(row[data.energy.column("residual")]) < 0.002 * bench.model->ledger().given());
        }
        // Spheres that have lost most of their bonds feel no volume change to speak of: their strain is not that of their cracks.
        const Model& m = *bench.model;
        double torn = 0.0;
        for (std::size_t k = 0; k < m.spheres.size(); ++k) {
            const auto degree = m.bonds.incidence.degree(k);
            std::uint32_t failed = 0;
            for (auto e = m.bonds.incidence.offset[k]; e < m.bonds.incidence.offset[k + 1]; ++e) {
                failed += m.bonds.mode[m.bonds.incidence.entry[e] >> 1] != 0 ? 1 : 0;
            }
            if (degree > 4 && failed + 1 >= degree) {
                torn = std::max(torn, m.bonds.dilatation.theta[k]);
            }
        }
        CHECK(torn < 5e-3);
        hashes.push_back(m.state_hash());
    }
    CHECK(hashes[0] == hashes[1]);
}
