// The facet law in the model: vectors and single facets, turning bonds, the strain around spheres, scatter, energy, threads.
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>

#include "core/bonds/bond_forces.hpp"
#include "core/geometry/lane_functions.hpp"
#include "core/laws/bond_laws.hpp"
#include "lab/strength_scatter.hpp"
#include "lab/test_run.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

Deck facet_deck(int spheres, const std::string& more = "{}") {
    input::Json json = input::Json::parse(R"({"test": "ucs", "specimen": {"diameter": "50 mm", "height": "100 mm"},
        "material": {"tensile_characteristic_length": "1 m"}, "output": {"fields": 0, "samples": 80}})");
    json["specimen"]["spheres"] = spheres;
    json.merge_patch(input::Json::parse(more));
    return read_deck(json, "test.json");
}

TestData pressed(const Deck& deck, Bench& bench) {
    return run_protocol(deck, bench, {[](const TestData&, double) {}, [] {}, [] { return false; }});
}

} // namespace

TEST_CASE("lane functions: against the C library, and the same bits on vectors") {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    constexpr auto n = lane_count<Lanes>();
    for (int trial = 0; trial < 20000; ++trial) {
        Lanes x{};
        Lanes y{};
        for (std::size_t k = 0; k < n; ++k) {
            x[k] = 60.0 * (uniform(random) - 0.5);
            y[k] = std::exp(40.0 * (uniform(random) - 0.5));
        }
        const Lanes e = exp_of(x);
        const Lanes l = log_of(y);
        const Lanes q = quarter_turn(y, Lanes(1.0));
        for (std::size_t k = 0; k < n; ++k) {
            REQUIRE(e[k] == exp_of(double{x[k]}));
            REQUIRE(l[k] == log_of(double{y[k]}));
            REQUIRE(q[k] == quarter_turn(double{y[k]}, 1.0));
            REQUIRE(e[k] == Approx(std::exp(x[k])).epsilon(3e-9));
            REQUIRE(l[k] == Approx(std::log(y[k])).epsilon(0).margin(1e-9));
            REQUIRE(q[k] == Approx(2.0 / std::numbers::pi * std::atan(y[k])).epsilon(0).margin(1e-9));
        }
    }
    CHECK(exp_of(-1e5) > 0.0); // held, not lost
    CHECK(quarter_turn(1.0, 0.0) == 1.0);
    CHECK(quarter_turn(0.0, 1.0) == 0.0);
}

TEST_CASE("facet: a vector of facets gives the bits of single ones, on a walk through every branch") {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    Facet::Parameters p;
    p.coupling = 0.6;
    p.kappa_c2 = 2.0;
    p.cohesion_loss = 0.5;
    const auto c = Facet::constants(p, {35e9, 0.36, 0.25});
    constexpr auto n = lane_count<Lanes>();
    constexpr double area = 5e-5;
    constexpr double length = 0.0077;
    const double k_n = 35e9 * area / length;
    std::vector<Facet::State<double>> single(n, {{0, 0, 0}, 0, 0, 0});
    Facet::State<Lanes> many{{0.0, 0.0, 0.0}, 0.0, 0.0, 0.0};
    std::vector<double> u(n, 0.0);
    std::size_t failed = 0;
    double plastic = 0.0;
    double friction = 0.0;
    for (int step = 0; step < 4000; ++step) {
        BondMotion<Lanes> kin{};
        std::vector<BondResponse<double>> r(n);
        Lanes around = 0.0;
        for (std::size_t k = 0; k < n; ++k) {
            // From compression into tension and back, each lane at its own pace.
            const double du = 4e-7 * std::cos(0.004 * (1.0 + 0.1 * static_cast<double>(k)) * step) + 2e-7 * uniform(random);
            const double dx = 4e-7 * uniform(random) + 1e-7;
            u[k] += du;
            around[k] = -u[k] / length * 0.3;
            kin.shortening[k] = u[k];
            kin.approach[k] = du;
            kin.slip[0][k] = dx;
            kin.slip[1][k] = 0.5 * dx;
            r[k] = Facet::advance<double>(c, {k_n, area, length, around[k], 0.9}, {u[k], du, {dx, 0.5 * dx, 0.0}}, single[k]);
            plastic += r[k].plastic_work;
            friction += r[k].friction_work;
        }
        const auto together = Facet::advance<Lanes>(c, {Lanes(k_n), Lanes(area), Lanes(length), around, Lanes(0.9)}, kin, many);
        for (std::size_t k = 0; k < n; ++k) {
            REQUIRE(together.normal[k] == r[k].normal);
            REQUIRE(together.shear[0][k] == r[k].shear[0]);
            REQUIRE(together.damage_work[k] == r[k].damage_work);
            REQUIRE(together.plastic_work[k] == r[k].plastic_work);
            REQUIRE(together.friction_work[k] == r[k].friction_work);
            REQUIRE(many.damage[k] == single[k].damage);
            REQUIRE(many.closed[k] == single[k].closed);
        }
    }
    for (const auto& s : single) {
        failed += Facet::failed(s) ? 1 : 0;
    }
    CHECK(failed > 0);
    CHECK(plastic > 0.0);
    CHECK(friction > 0.0);
}

TEST_CASE("facet: forces of a damaged facet turn with the bond") {
    // A pair opened and sheared until it is damaged, then turned as a rigid body by 2 rad about a slanted axis in small steps.
    Material m;
    m.bond = Facet::Parameters{};
    Spheres s = two_spheres(0.004);
    Bonds b = one_bond(s, m);
    prepare_bond_forces(b, true);
    Loads loads(s.size());
    loads.arrange({{b.i, b.j, b.row_j}});
    std::vector<BondFailure> failures;
    const double dt = 1e-6;
    const auto advance = [&] { bond_forces(s.view(), b, b.view(), 0, loads.rows(), dt, true, failures); };
    const Vec3 opening(12e-9, 2e-8, 1e-8); // a step
    for (int k = 0; k < 100; ++k) {
        s.velocity.set(1, opening / dt);
        s.position.set(1, s.position.at(1) + opening);
        advance();
    }
    const double normal = b.normal[0];
    const double shear = b.shear[0];
    CHECK(b.memory[1][0] > 0.3); // damage
    CHECK(failures.empty());
    const Vec3 force = b.force.at(0);
    const Vec3 axis = Vec3(1.0, 2.0, -0.5).normalized();
    const int steps = 20000;
    const double angle = 2.0 / steps;
    const Eigen::AngleAxisd turn(angle, axis);
    Eigen::Matrix3d whole = Eigen::Matrix3d::Identity();
    for (int k = 0; k < steps; ++k) {
        for (std::size_t i = 0; i < 2; ++i) {
            const Vec3 after = turn * s.position.at(i);
            s.velocity.set(i, axis.cross(after) * angle / dt);
            s.spin.set(i, axis * angle / dt);
            s.position.set(i, after);
        }
        whole = turn.toRotationMatrix() * whole;
        advance();
    }
    // The frame is carried to second order in the angle of a step, 1e-4.
    CHECK(b.normal[0] == Approx(normal).epsilon(1e-6));
    CHECK(b.shear[0] == Approx(shear).epsilon(1e-6));
    CHECK((b.force.at(0) - whole * force).norm() < 1e-3 * force.norm());
    CHECK(failures.empty());
}

TEST_CASE("facet: the strain around spheres is a third of the trace, on the whole") {
    const Deck deck = facet_deck(800, R"({"material": {"volumetric_deviatoric_coupling": 0.5}})");
    Bench bench = set_up(deck, make_specimen(deck.specimen));
    Model& m = *bench.model;
    REQUIRE(m.bonds.volumetric.active());
    const Vec3 strain(2e-4, -1e-4, 3e-4);
    for (std::size_t k = 0; k < m.spheres.size(); ++k) {
        m.spheres.position.set(k, m.spheres.start.at(k) + strain.cwiseProduct(m.spheres.start.at(k)));
    }
    measure_volumetric_strain(m.spheres, m.bonds, 0, m.spheres.size());
    double sum = 0.0;
    double count = 0.0;
    const Shape::Region inner = bench.specimen.shape.inner(0.6, 0.6);
    for (std::size_t k = 0; k < m.spheres.size(); ++k) {
        if (inner.contains(m.spheres.start.at(k))) {
            sum += m.bonds.volumetric.strain[k];
            count += 1.0;
        }
    }
    CHECK(sum / count == Approx(strain.sum() / 3.0).epsilon(0.02)); // single spheres have uneven bonds
    const Deck own = facet_deck(300, R"({"material": {"volumetric_deviatoric_coupling": 1}})");
    CHECK_FALSE(set_up(own, make_specimen(own.specimen)).model->bonds.volumetric.active());
}

TEST_CASE("facet: a pressed specimen breaks, its energy closes, threads change no bit, with the strain around facets too") {
    for (const char* more : {"{}", R"({"material": {"volumetric_deviatoric_coupling": 0.9, "deviatoric_damage": 0.01, "cohesion_loss": 1,
                                                    "weibull_modulus": 8, "correlation_length": "20 mm"}})"}) {
        INFO(more);
        std::optional<std::uint64_t> state;
        for (const int threads : {1, 2}) {
            const Deck deck = facet_deck(1500, more);
            Bench bench = set_up(deck, make_specimen(deck.specimen));
            bench.model->set_threads(threads);
            const TestData data = pressed(deck, bench);
            CHECK(data.failure.empty());
            CHECK(data.events.size() > 50);
            const Ledger& ledger = bench.model->ledger();
            CHECK(std::fabs(ledger.relative_residual()) < 1e-3);
            CHECK(ledger.damage > 0.0);
            CHECK(ledger.plastic > 0.0);
            CHECK(ledger.friction > 0.0);
            if (state) {
                CHECK(bench.model->state_hash() == *state);
            }
            state = bench.model->state_hash();
        }
    }
}

TEST_CASE("facet: the averaged part of the stress strains a facet and what is around it alike") {
    // Under all-round strain every facet and the mean around it have the same strain, with the averaged part as without.
    const Deck deck = facet_deck(800, R"({"material": {"poisson_ratio": 0.3}})");
    Bench bench = set_up(deck, make_specimen(deck.specimen));
    Model& m = *bench.model;
    REQUIRE(m.bonds.dilatation.active());
    for (std::size_t k = 0; k < m.spheres.size(); ++k) {
        m.spheres.position.set(k, 0.9999 * m.spheres.start.at(k));
    }
    measure_elongations(m.spheres, m.bonds, 0, m.bonds.size());
    measure_dilatation(m.bonds, 0, m.spheres.size());
    set_shifts(m.bonds, 0, m.bonds.size());
    measure_volumetric_strain(m.spheres, m.bonds, 0, m.spheres.size());
    double facet = 0.0;
    double around = 0.0;
    double weight = 0.0;
    const Shape::Region inner = bench.specimen.shape.inner(0.6, 0.6);
    for (std::size_t b = 0; b < m.bonds.size(); ++b) {
        const auto i = static_cast<std::size_t>(m.bonds.i[b]);
        if (inner.contains(m.spheres.start.at(i))) {
            const double volume = m.bonds.area[b] * m.bonds.length[b];
            facet += volume * (-1e-4 + m.bonds.dilatation.shift[b] / m.bonds.length[b]);
            around += volume * m.bonds.volumetric.strain[i];
            weight += volume;
        }
    }
    CHECK(facet / weight < -1.2e-4); // the averaged part is a good part of it
    CHECK(around / facet == Approx(1.0).epsilon(0.02));
}

TEST_CASE("facet: two materials meet by the weaker strength, cohesion and fracture energy, and the wider scatter") {
    Facet::Parameters a;
    a.sigma_t = 2e6;
    a.shear_ratio_t = 8.0;
    a.length_t = 0.5;
    Facet::Parameters b;
    b.sigma_t = 4e6;
    b.shear_ratio_t = 3.0;
    b.length_t = 0.1;
    b.weibull_modulus = 8.0;
    b.correlation_length = 0.02;
    for (const auto& m : {Facet::mix(a, b), Facet::mix(b, a)}) {
        CHECK(m.sigma_t == 2e6);
        CHECK(m.sigma_t * m.shear_ratio_t == Approx(12e6));
        CHECK(m.sigma_t * m.sigma_t * m.length_t == Approx(4e6 * 4e6 * 0.1));
        CHECK(m.weibull_modulus == 8.0);
        CHECK(m.correlation_length == 0.02);
    }
}

TEST_CASE("facet: scatter of strength has the mean 1, Weibull's spread, and is alike over its length") {
    const auto deck = [](const std::string& length) {
        return facet_deck(1500, R"({"material": {"weibull_modulus": 6, "correlation_length": ")" + length + R"("}})");
    };
    const Bench bench = set_up(deck("0 mm"), make_specimen(deck("0 mm").specimen));
    const Bonds& b = bench.model->bonds;
    REQUIRE(b.strength.size() == b.size());
    double mean = 0.0;
    double square = 0.0;
    for (const double f : b.strength) {
        mean += f / static_cast<double>(b.size());
        square += f * f / static_cast<double>(b.size());
    }
    const double gamma = std::tgamma(1.0 + 1.0 / 6.0);
    const double spread = std::sqrt(std::tgamma(1.0 + 2.0 / 6.0) / (gamma * gamma) - 1.0);
    CHECK(mean == Approx(1.0).margin(4.0 * spread / std::sqrt(static_cast<double>(b.size())))); // four standard errors
    CHECK(std::sqrt(square - mean * mean) == Approx(spread).epsilon(0.05));

    // Bonds of one sphere lie within 10 mm of each other: over 100 mm they are alike, by themselves they are not.
    const auto unlike = [](const Bench& of) {
        const Bonds& x = of.model->bonds;
        double sum = 0.0;
        for (std::size_t k = 1; k < x.size(); ++k) {
            sum += x.i[k] == x.i[k - 1] ? std::fabs(x.strength[k] - x.strength[k - 1]) : 0.0;
        }
        return sum;
    };
    const Bench wide = set_up(deck("100 mm"), make_specimen(deck("100 mm").specimen));
    CHECK(unlike(wide) < 0.2 * unlike(bench));
    const Bench again = set_up(deck("100 mm"), make_specimen(deck("100 mm").specimen));
    CHECK(again.model->bonds.strength == wide.model->bonds.strength);
}

TEST_CASE("facet: elasticity survives confinement, in small unloadings and after a hydrostatic test") {
    const auto value = [](const Deck& deck, const std::string& name) {
        Bench bench = set_up(deck, make_specimen(deck.specimen));
        const TestData data = pressed(deck, bench);
        for (const auto& r : deck.protocol->results({data.curve, data.energy, data.events, bench.specimen.shape, bench.press})) {
            if (r.name == name) {
                return r.value.value();
            }
        }
        return 0.0;
    };
    const Deck confined = facet_deck(1500, R"({"test": "triaxial", "loading": {"confining_pressure": "30 MPa",
        "cycles": [{"axial_strain": 0.008, "unload_to": 0.7}], "stop": {"axial_strain": 0.0082}}})");
    CHECK(value(confined, "unloading_modulus_1") == Approx(28.6e9).epsilon(0.15));
    const Deck pressure = facet_deck(1500, R"({"test": "hydrostatic", "loading": {"pressure": "100 MPa", "unload_to": 0.5}})");
    const double bulk = 28.6e9 / (3.0 * (1.0 - 2.0 * 0.177));
    CHECK(value(pressure, "bulk_modulus") == Approx(bulk).epsilon(0.03));
    CHECK(value(pressure, "unloading_modulus") == Approx(bulk).epsilon(0.2));
}
