// Loose contacts beyond the cases of `proveta verify`: paths worked out by hand, oblique impacts, rolling, mixed materials, checkpoints.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "core/contacts/hertz_law.hpp"
#include "core/contacts/restitution.hpp"
#include "core/contacts/rolling.hpp"
#include "tests/support.hpp"

#ifdef _OPENMP
#include <omp.h>
#endif

using namespace proveta;
using namespace proveta::testing;

namespace {

Material loose(ContactLaw law) {
    Material m = unbreakable(1e7);
    m.contact_law = law;
    m.contact_restitution = 0.6;
    m.mu_d = 0.3;
    m.rolling_friction = 0.02;
    return m;
}

// A heap of spheres of two materials and unequal sizes, falling onto a wall; none are bonded.
Model heap(ContactLaw law, int count, double safety = 0.9) {
    std::vector<Material> materials{loose(law), loose(ContactLaw::hertz)};
    materials[1].young_modulus = 3e7;
    Spheres s;
    for (int k = 0; k < count; ++k) {
        const double x = 0.021 * (k % 3) + 0.001 * ((7 * k) % 5);
        const double y = 0.021 * ((k / 3) % 3) + 0.001 * ((11 * k) % 7);
        s.add({x, y, 0.0098 + 0.0205 * (k / 9)}, 0.008 + 0.0005 * (k % 5), 2500.0, 0, k % 2);
        s.velocity.set(s.size() - 1, {0.1 * (k % 3 - 1), -0.05 * (k % 4), -0.5});
    }
    std::vector<double> weight;
    Bonds none = make_bonds(s, materials, {}, std::vector<std::uint8_t>(s.size(), 0), weight);
    const std::vector<Platen> floor{make_wall(s, {}, 0.0, materials[0], 0.4)};
    Numerics numerics;
    numerics.damping = {0.0, 0.0};
    numerics.gravity = {0, 0, -9.81};
    numerics.safety = safety;
    return {s, materials, none, weight, floor, numerics};
}

} // namespace

TEST_CASE("hertz: force and tangential spring along a path worked out by hand") {
    // k_n = 2e9 sqrt(d), k_t = 1e9 sqrt(d), no dashpots, no sliding; overlaps 1, 4, 1, 0 micrometres with slips of 10, 20, 5 and 5 nm.
    const hertz::Parameters<double> p{2e9, 1e9, 0.0, 0.0, 1e9, false};
    contact::State<double> s{};
    double before = 0.0;
    double friction = 0.0;
    double work = 0.0;
    double force = 0.0;
    double stored = 0.0;
    const auto to = [&](double overlap, double step) {
        const double slip[3] = {0.0, step, 0.0};
        const auto r = hertz::advance<double>(p, overlap, overlap - before, 1e-6, slip, s);
        work += 0.5 * (force + r.shear[1]) * step;
        before = overlap;
        friction += r.friction_work;
        force = r.shear[1];
        stored = r.stored - 0.4 * r.normal * std::max(overlap, 0.0); // of the tangential spring
        return r;
    };
    auto r = to(1e-6, 10e-9);
    CHECK(r.normal == Approx(2.0 / 3.0 * 2e9 * 1e-9).epsilon(1e-12)); // 2/3 K d^(3/2)
    CHECK(r.stored == Approx(0.4 * 4.0 / 3.0 * 1e-6 + 0.5 * 1e6 * 1e-16).epsilon(1e-12));
    CHECK(r.shear[1] == Approx(1e6 * 10e-9).epsilon(1e-12)); // k_t = 1e6
    r = to(4e-6, 20e-9);                                     // loading, k_t = 2e6: the old 10 mN stay
    CHECK(r.shear[1] == Approx(10e-3 + 2e6 * 20e-9).epsilon(1e-12));
    CHECK(friction == Approx(0.5 * 1e-4 * (1e-6 - 0.5e-6)).epsilon(1e-12)); // F^2/2 (1/k_old - 1/k_new)
    r = to(1e-6, 5e-9); // unloading, k_t = 1e6: the old 50 mN are halved, then the slip comes on top
    CHECK(r.shear[1] == Approx(25e-3 + 1e6 * 5e-9).epsilon(1e-12));
    CHECK(work == Approx(stored + friction).epsilon(1e-12));
    r = to(0.0, 5e-9);
    CHECK(r.shear[1] == 0.0);
    CHECK(s.u_t[1] == 0.0);
    CHECK(work == Approx(friction).epsilon(1e-12));
}

TEST_CASE("hertz: sliding is capped by Coulomb, dashpot included, and its energies add up") {
    const hertz::Parameters<double> p{2e9, 1e9, 0.0, 300.0, 0.2, false};
    contact::State<double> s{};
    double work = 0.0;
    double lost = 0.0;
    double force[2] = {0.0, 0.0};
    double stored = 0.0;
    double before = 0.0;
    for (int k = 1; k <= 4000; ++k) {
        const double overlap = 4e-6 * std::sin(k * std::numbers::pi / 4000.0);
        const double slip[3] = {1e-8 * std::sin(k / 500.0), 0.5e-8, 0.0};
        const auto r = hertz::advance<double>(p, overlap, overlap - before, 1e-6, slip, s);
        before = overlap;
        REQUIRE(std::hypot(r.shear[0], r.shear[1]) <= 0.2 * r.normal * (1 + 1e-12));
        for (int c = 0; c < 2; ++c) {
            work += 0.5 * (force[c] + r.shear[c]) * slip[c];
            force[c] = r.shear[c];
        }
        lost += r.friction_work + r.dashpot_work;
        stored = r.stored - 0.4 * r.normal * overlap;
    }
    CHECK(lost + stored == Approx(work).epsilon(1e-9));
}

TEST_CASE("restitution: the correction inverts the closed form from nearly none to one, overdamped contacts included") {
    for (const double e : {1e-3, 0.05, std::exp(-2.0), 0.2, 0.5, 0.999, 1.0}) {
        INFO(e);
        CHECK(restitution::cut(restitution::ratio_cut(e)) == Approx(e).epsilon(1e-6));
    }
    CHECK(restitution::ratio_cut(1.0) == 0.0);
    CHECK(restitution::ratio_pulling(0.5) == Approx(0.21545).epsilon(1e-4));
}

TEST_CASE("oblique impacts with friction, spin and damping close the energy ledger and keep both momenta") {
    for (const auto law : {ContactLaw::linear, ContactLaw::hertz}) {
        std::vector<Material> materials{loose(law), loose(law)};
        materials[1].young_modulus = 2e7;
        materials[1].poisson_ratio = 0.3;
        Spheres s;
        s.add({0, 0, 0}, 0.01, 2500.0, 0, 0);
        s.add({0.0175, 0.0105, 0}, 0.0102, 2000.0, 1, 1);
        s.velocity.set(0, {1.0, 0.5, 0.1});
        s.spin.set(0, {0, 3, 40});
        s.spin.set(1, {10, 0, -5});
        std::vector<double> weight;
        Bonds none = make_bonds(s, materials, {}, {0, 0}, weight);
        Numerics numerics;
        numerics.damping = {0.0, 0.0};
        numerics.time_step = 1e-6;
        Model m(s, materials, none, weight, {}, numerics);
        const auto momentum = [&] {
            return Vec3(m.spheres.mass[0] * m.spheres.velocity.at(0) + m.spheres.mass[1] * m.spheres.velocity.at(1));
        };
        const auto angular = [&] {
            Vec3 h = Vec3::Zero();
            for (std::size_t k = 0; k < 2; ++k) {
                h += m.spheres.mass[k] * m.spheres.position.at(k).cross(m.spheres.velocity.at(k)) +
                     m.spheres.inertia[k] * m.spheres.spin.at(k);
            }
            return h;
        };
        const Vec3 p = momentum();
        const Vec3 h = angular();
        double worst = 0.0;
        bool touched = false;
        bool apart = true;
        for (int k = 0; k < 10000; ++k) {
            m.step({}, true);
            worst = std::max(worst, std::fabs(m.ledger().relative_residual()));
            apart = m.contacts.size() == 0 || !(m.contacts.normal[0] > 0.0);
            touched = touched || !apart;
        }
        INFO((law == ContactLaw::hertz ? "hertz" : "linear"));
        REQUIRE(touched);
        CHECK(apart);
        CHECK(m.ledger().friction > 0.01 * m.ledger().initial);
        CHECK(m.ledger().dashpots > 0.02 * m.ledger().initial);
        CHECK(worst < 1e-3);
        CHECK((momentum() - p).norm() < 1e-12 * p.norm());
        CHECK((angular() - h).norm() < 1e-6 * h.norm()); // lever arms are shares of the true distance
    }
}

TEST_CASE("rolling resistance never drives motion: not with twenty contacts at once, not in a heap that comes to rest") {
    double spin[3] = {0.3, -0.2, 0.1};
    const double start = std::hypot(spin[0], spin[1], spin[2]);
    double before = start;
    for (int step = 0; step < 50; ++step) {
        double sum[3] = {0, 0, 0};
        for (int contact = 0; contact < 20; ++contact) {
            const auto r = rolling::torque<double>(1e-2, 1e6, 2e-5, spin, 1e-6);
            for (int c = 0; c < 3; ++c) {
                sum[c] += r.torque[c];
            }
        }
        for (int c = 0; c < 3; ++c) {
            spin[c] += sum[c] / 2e-5 * 1e-6;
        }
        const double size = std::hypot(spin[0], spin[1], spin[2]);
        REQUIRE(size <= before);
        before = size;
    }
    CHECK(before < 1e-12 * start);
    const double none[3] = {0, 0, 0};
    CHECK(rolling::torque<double>(1e-2, 1e6, 2e-5, none, 1e-6).torque[0] == 0.0);

    Model m = heap(ContactLaw::linear, 27, 0.1); // the ledger of an impact closes with the square of the step
    for (int k = 0; k < 40000; ++k) {
        m.step({0.0}, k % 20 == 0);
        REQUIRE((k % 20 != 0 || std::fabs(m.ledger().relative_residual()) < 2e-3));
    }
    CHECK(m.ledger().kinetic < 0.1 * m.ledger().given());
    CHECK(m.ledger().friction > 0.0);
}

TEST_CASE("materials: a contact of two is symmetric, takes the lower friction and the default law unless both ask for another") {
    Material a = loose(ContactLaw::hertz);
    Material b = loose(ContactLaw::hertz);
    b.young_modulus = 5e7;
    b.poisson_ratio = 0.35;
    b.rolling_friction = 0.01;
    const LoosePair ab = loose_pair(a, b);
    const LoosePair ba = loose_pair(b, a);
    CHECK(ab.law == ContactLaw::hertz);
    CHECK(ab.young == Approx(1.0 / (0.96 / 1e7 + (1 - 0.35 * 0.35) / 5e7)));
    CHECK(ab.shear == Approx(1.0 / (1.8 / (1e7 / 2.4) + 1.65 / (5e7 / 2.7))));
    CHECK(ab.young == ba.young);
    CHECK(ab.shear == ba.shear);
    CHECK(ab.axial == ba.axial);
    CHECK(ab.damping == ba.damping);
    CHECK(ab.rolling == 0.01);
    const LooseContact one = loose_contact(ab, {0.01, 0.01, 4e-7}, {0.02, 0.08, 1.28e-5}, 0.0);
    const LooseContact two = loose_contact(ba, {0.02, 0.08, 1.28e-5}, {0.01, 0.01, 4e-7}, 0.0);
    CHECK(one.k_n == two.k_n);
    CHECK(one.rolling_arm == 0.01 * 0.01);
    CHECK(one.reduced_inertia == two.reduced_inertia);
    b.contact_law = ContactLaw::linear;
    CHECK(loose_pair(a, b).law == ContactLaw::linear);
    Material rigid = a;
    rigid.young_modulus = std::numeric_limits<double>::infinity();
    const LoosePair wall = wall_pair(a, rigid, 0.7);
    CHECK(wall.young == Approx(1e7 / 0.96));
    CHECK(wall.shear == Approx(1e7 / 2.4 / 1.8)); // (2.41d)
    CHECK(wall.axial == Approx(2e7));
    CHECK(wall.friction == 0.7);
    CHECK(wall_contact(wall, {0.01, 0.02, 8e-7}, 3e-4).k_n == Approx(2.0 * 1e7 / 0.96 * 0.1));
}

TEST_CASE("heap: the step bound counts loose contacts, thread counts change no bit, a checkpoint goes on bit for bit") {
    Model m = heap(ContactLaw::hertz, 27);
    // Two equal spheres and nothing else: 2/sqrt(7 k_t/m) or 2/sqrt(2 k_n/m) at the overlap of the skin.
    {
        const Material h = loose(ContactLaw::hertz);
        Material free_of_dashpots = h;
        free_of_dashpots.contact_restitution = 1.0;
        free_of_dashpots.rolling_friction = 0.0;
        Spheres s = two_spheres(0.01);
        std::vector<double> weight;
        Bonds none = make_bonds(s, {h}, {}, {0, 0}, weight);
        Numerics undamped;
        undamped.damping = {0.0, 0.0};
        const Model pair(s, {free_of_dashpots}, none, weight, {}, undamped);
        const double root = std::sqrt(0.005 * 0.001); // R_eq times the skin, a tenth of the radius
        const double k_n = 2.0 * 1e7 / (2.0 * 0.96) * root;
        const double k_t = 8.0 * (1e7 / 2.4) / (2.0 * 1.8) * root;
        const double critical = 2.0 / std::sqrt(std::max(2.0 * k_n, 7.0 * k_t) / s.mass[0]);
        CHECK(pair.stable_step() == Approx(critical).epsilon(1e-6));
    }
    const auto run = [](Model& model, int steps) {
        for (int k = 0; k < steps; ++k) {
            model.step({0.0}, k % 100 == 0);
        }
    };
    run(m, 3000);
    REQUIRE(m.contacts.rolls);
    const auto file = (std::filesystem::temp_directory_path() / ("proveta_heap_" + std::to_string(::getpid()) + ".h5")).string();
    save_model(m, file);
    run(m, 2000);
    Model second = heap(ContactLaw::hertz, 27);
    load_model(second, file);
    run(second, 2000);
    CHECK(second.state_hash() == m.state_hash());
    CHECK(second.ledger().friction == m.ledger().friction);
    CHECK(second.ledger().dashpots == m.ledger().dashpots);
    CHECK(second.ledger().initial == m.ledger().initial);
    std::filesystem::remove(file);
#ifdef _OPENMP
    const int threads = omp_get_max_threads();
    std::uint64_t hash[2];
    for (int k = 0; k < 2; ++k) {
        omp_set_num_threads(k + 1);
        Model big = heap(ContactLaw::hertz, 1100);
        run(big, 60);
        hash[k] = big.state_hash();
    }
    omp_set_num_threads(threads);
    CHECK(hash[0] == hash[1]);
#endif
}
