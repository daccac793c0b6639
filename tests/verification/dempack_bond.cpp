// The bond law against closed forms, path by path (thesis 5.2.3 to 5.2.5). Forces to 1e-12, energies against areas under curves.
#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

#include "core/laws/bond/dempack_law.hpp"
#include "specimens/random.hpp"

using namespace proveta;
template <class T> using State = Dempack::State<T>;

namespace {

constexpr double k_n = 7.0e7;   // N/m
constexpr double area = 5.0e-5; // m2
constexpr double exact = 1e-12; // a few roundings of quantities of order one

// A bond that is moved about, with its work and dissipation on record.
struct TestBond {
    Dempack::Constants p;
    State<double> s{{0, 0, 0}, 0, 0, 0};
    BondResponse<double> r{};
    double u = 0.0;      // shortening
    double work = 0.0;   // trapezoidal, of the force on the bond
    double volume = 0.0; // sum of |increments of work|
    double dissipated = 0.0;
    double damage = 0.0, plastic = 0.0, friction = 0.0;

    void move(double du, double dx = 0.0, double dy = 0.0) {
        const auto before = r;
        u += du;
        r = Dempack::advance<double>(p, {k_n, area, 0.0, 0.0, 1.0}, BondMotion<double>{u, du, {dx, dy, 0.0}}, s);
        const double w =
            0.5 * ((before.normal + r.normal) * du + (before.shear[0] + r.shear[0]) * dx + (before.shear[1] + r.shear[1]) * dy);
        work += w;
        volume += std::fabs(w);
        damage += r.damage_work;
        plastic += r.plastic_work;
        friction += r.friction_work;
        dissipated = damage + plastic + friction;
    }
    void to(double target, int steps) {
        const double du = (target - u) / steps;
        for (int k = 0; k < steps; ++k) {
            move(du);
        }
    }
    void shear(double dx, int steps) {
        for (int k = 0; k < steps; ++k) {
            move(0.0, dx / steps);
        }
    }
    double stored() { return Dempack::stored_energy<double>(p, {k_n, area, 0.0, 0.0, 1.0}, {u, 0.0, {0.0, 0.0, 0.0}}, r.normal, s); }
    double k_t() const { return k_n * p.shear_ratio; }
};

} // namespace

TEST_CASE("dempack-bond: tension softens along the parabola, unloads to the origin, fails at u_f") {
    TestBond b;
    const double u_l = b.p.sigma_f * area / k_n;
    b.to(-0.7 * u_l, 10);
    CHECK(b.r.normal == Approx(-k_n * 0.7 * u_l).epsilon(exact));
    b.to(-1.08 * u_l, 1000);
    const double d = 0.08 / 0.2;
    CHECK(b.s.d_n == Approx(d).epsilon(1e-10));
    CHECK(b.r.normal == Approx(-(1 - d) * k_n * 1.08 * u_l).epsilon(1e-10));
    b.to(-0.5 * u_l, 7); // secant to the origin
    CHECK(b.r.normal == Approx(-(1 - d) * k_n * 0.5 * u_l).epsilon(1e-10));
    b.to(0.3 * u_l, 8); // compression keeps its stiffness
    CHECK(b.r.normal == Approx(k_n * 0.3 * u_l).epsilon(1e-10));
    b.to(-1.08 * u_l, 9); // reloading reaches the same point
    CHECK(b.r.normal == Approx(-(1 - d) * k_n * 1.08 * u_l).epsilon(1e-10));
    CHECK(b.s.d_n == Approx(d).epsilon(1e-10));
    b.to(-1.1999 * u_l, 100);
    CHECK(b.s.d_n < 1.0);
    b.to(-1.2001 * u_l, 100);
    CHECK(b.s.d_n == 1.0);
    CHECK(b.r.normal == 0.0);
}

TEST_CASE("dempack-bond: the energy of a tension failure is the area under the curve") {
    TestBond b;
    const double u_l = b.p.sigma_f * area / k_n;
    b.to(-1.3 * u_l, 20000);
    // k u_l^2 (r^2 + r + 1) / 6 with r = u_f / u_l; the trapezoidal rule over 20,000 steps is good to 1e-7 of it.
    const double r = 1.2;
    CHECK(b.damage == Approx(k_n * u_l * u_l * (r * r + r + 1) / 6).epsilon(1e-6));
    CHECK(b.stored() == 0.0);
    CHECK(b.work == Approx(b.damage).epsilon(1e-10));
}

TEST_CASE("dempack-bond: one huge step into failure loses no energy either") {
    TestBond b;
    const double u_l = b.p.sigma_f * area / k_n;
    b.to(-0.9 * u_l, 1);
    b.to(-2.0 * u_l, 1);
    CHECK(b.s.d_n == 1.0);
    CHECK(b.work == Approx(b.dissipated + b.stored()).epsilon(exact));
}

TEST_CASE("dempack-bond: compression follows the envelope past every LCS, unloads with k_n, and returns to where it left") {
    TestBond b;
    // Corners of the envelope: elastic strain-like u k_n / A at which each branch begins.
    const double u1 = 20e6 * area / k_n;
    const double u2 = u1 + 3.0 * 25e6 * area / k_n;
    const double u3 = u2 + 12.0 * 25e6 * area / k_n;
    const double u4 = u3 + 22.0 * 10e6 * area / k_n;
    const auto stress = [&] { return b.r.normal / area; };
    b.to(0.5 * u1, 10);
    CHECK(stress() == Approx(10e6).epsilon(exact));
    b.to(u1, 10);
    CHECK(stress() == Approx(20e6).epsilon(exact));
    b.to(0.5 * (u1 + u2), 10);
    CHECK(stress() == Approx(32.5e6).epsilon(exact));
    const double left = b.u;
    b.to(left - 10e6 * area / k_n, 5); // initial slope
    CHECK(stress() == Approx(22.5e6).epsilon(exact));
    b.to(left + 1e-9, 5);
    CHECK(stress() == Approx(32.5e6 + 1e-9 * k_n / 3.0 / area).epsilon(exact));
    b.to(u2, 10);
    CHECK(stress() == Approx(45e6).epsilon(exact));
    b.to(u3, 10);
    CHECK(stress() == Approx(70e6).epsilon(exact));
    b.to(u4, 10);
    CHECK(stress() == Approx(80e6).epsilon(exact));
    const double u_p = u4 - 80e6 * area / k_n;
    CHECK(b.s.u_p == Approx(u_p).epsilon(exact));
    b.to(u_p, 10); // back to no force: the plastic shortening stays
    CHECK(std::fabs(stress()) < 1e-12 * 80e6);
    // On into tension from there, without a jump, with the whole tensile strength.
    b.to(u_p - 0.5 * 5e6 * area / k_n, 10);
    CHECK(stress() == Approx(-2.5e6).epsilon(1e-10));
    b.to(u_p - 1.01 * 1.2 * 5e6 * area / k_n, 100);
    CHECK(b.s.d_n == 1.0);
}

TEST_CASE("dempack-bond: plastic energy is the area between loading and unloading") {
    TestBond b;
    const double u1 = 20e6 * area / k_n;
    const double u2 = u1 + 3.0 * 25e6 * area / k_n;
    b.to(u2, 5000);
    const double under = 0.5 * 20e6 * area * u1 + 0.5 * (20e6 + 45e6) * area * (u2 - u1);
    const double elastic = 0.5 * std::pow(45e6 * area, 2) / k_n;
    CHECK(b.plastic == Approx(under - elastic).epsilon(1e-3)); // one step straddles the corner of the envelope
    CHECK(b.stored() == Approx(elastic).epsilon(1e-10));
    CHECK(b.work == Approx(b.dissipated + b.stored()).epsilon(1e-10));
}

TEST_CASE("dempack-bond: shear strength is tau_f A + mu_s F_n and follows the normal force") {
    for (const double pressure : {0.0, 15e6}) {
        TestBond b;
        b.to(pressure * area / k_n, 10);
        const double limit = 16e6 * area + 0.9 * pressure * area;
        const double u_l = limit / b.k_t();
        b.shear(0.999 * u_l, 100);
        CHECK(b.s.d_t == 0.0);
        CHECK(b.r.shear[0] == Approx(b.k_t() * 0.999 * u_l).epsilon(exact));
        b.shear(0.101 * u_l, 1000); // halfway down
        CHECK(b.s.d_t == Approx(0.5).epsilon(1e-9));
        CHECK(b.r.shear[0] == Approx(0.5 * b.k_t() * 1.1 * u_l).epsilon(1e-9));
        b.shear(-1.1 * u_l, 50);
        CHECK(b.r.shear[0] == Approx(0.0).margin(1e-9 * limit));
        b.shear(1.21 * u_l, 1000);
        CHECK(b.s.d_t == 1.0);
        CHECK(b.r.normal == Approx(pressure * area).epsilon(exact).margin(1e-12)); // no jump in the normal force
        const double work_before = b.work;
        // Friction after failure: same stiffness, limit mu_d F_n.
        b.shear(2.0 * u_l, 1000);
        CHECK(b.r.shear[0] == Approx(0.25 * pressure * area).epsilon(1e-9).margin(1e-12));
        CHECK(b.work - work_before == Approx(0.25 * pressure * area * 2.0 * u_l).epsilon(0.25).margin(1e-12));
    }
}

TEST_CASE("dempack-bond: a lower normal force lowers the limit and damages a bond that does not move") {
    TestBond b;
    b.to(15e6 * area / k_n, 10);
    const double limit = 16e6 * area + 0.9 * 15e6 * area;
    b.shear(0.95 * limit / b.k_t(), 100);
    CHECK(b.s.d_t == 0.0);
    b.to(0.0, 1000);
    CHECK(b.s.d_t == 1.0);
}

TEST_CASE("dempack-bond: tension damage leaves the shear branch alone, and failure in tension ends both") {
    TestBond b;
    const double u_l = 5e6 * area / k_n;
    b.to(-1.1 * u_l, 1000);
    CHECK(b.s.d_n == Approx(0.5).epsilon(1e-9));
    b.shear(1e-7, 10);
    CHECK(b.r.shear[0] == Approx(b.k_t() * 1e-7).epsilon(exact));
    b.to(-1.3 * u_l, 1000);
    CHECK(b.r.shear[0] == 0.0);
    CHECK(b.stored() == 0.0);
    CHECK(b.work == Approx(b.dissipated).epsilon(1e-9));
}

TEST_CASE("dempack-bond: damage never heals and energy is neither made nor lost on random paths") {
    Random random(11, Stream::positions);
    const double u_l = 5e6 * area / k_n;
    for (int path = 0; path < 50; ++path) {
        TestBond b;
        double last = 0.0;
        for (int leg = 0; leg < 30; ++leg) {
            const double du = (random.uniform() - 0.45) * 6.0 * u_l / 400;
            const double dx = (random.uniform() - 0.5) * 8.0 * u_l / 400;
            const double dy = (random.uniform() - 0.5) * 8.0 * u_l / 400;
            for (int k = 0; k < 400; ++k) {
                b.move(du, dx, dy);
                REQUIRE(b.s.d_n + b.s.d_t >= last);
                last = b.s.d_n + b.s.d_t;
                REQUIRE(b.r.damage_work >= -1e-18);
                REQUIRE(b.r.plastic_work >= -1e-18);
                REQUIRE(b.r.friction_work >= -1e-18);
            }
        }
        // Exact but for steps across zero force, where a damaged bond changes stiffness within the step.
        CHECK(b.work == Approx(b.dissipated + b.stored()).margin(1e-3 * b.volume));
    }
}

TEST_CASE("dempack-bond: a bond without strength fails at the first pull and divides nothing by zero") {
    TestBond b;
    b.p.sigma_f = 0.0;
    b.p.tau_f = 0.0;
    b.move(0.0);
    CHECK(b.s.d_n == 0.0);
    b.to(1e-6, 3);
    CHECK(b.r.normal == Approx(k_n * 1e-6));
    b.to(-1e-9, 3);
    CHECK(b.s.d_n == 1.0);
    CHECK(b.r.normal == 0.0);
    CHECK(std::isfinite(b.dissipated));
}

TEST_CASE("dempack-bond: a vector of bonds gives the bits of single bonds") {
    Random random(12, Stream::positions);
    Dempack::Constants p;
    constexpr auto n = lane_count<Lanes>();
    std::vector<State<double>> single(n, State<double>{{0, 0, 0}, 0, 0, 0});
    State<Lanes> many{{0.0, 0.0, 0.0}, 0.0, 0.0, 0.0};
    std::vector<double> u(n, 0.0);
    for (int step = 0; step < 2000; ++step) {
        BondMotion<Lanes> kin{};
        std::vector<BondResponse<double>> r(n);
        for (std::size_t k = 0; k < n; ++k) {
            const double du = (random.uniform() - 0.49) * 2e-6;
            const double dx = (random.uniform() - 0.5) * 4e-6;
            u[k] += du;
            kin.shortening[k] = u[k];
            kin.approach[k] = du;
            kin.slip[0][k] = dx;
            kin.slip[1][k] = 0.5 * dx;
            kin.slip[2][k] = 0.0;
            r[k] = Dempack::advance<double>(p, {k_n, area, 0.0, 0.0, 1.0}, BondMotion<double>{u[k], du, {dx, 0.5 * dx, 0.0}}, single[k]);
        }
        const auto together = Dempack::advance<Lanes>(p, {Lanes(k_n), Lanes(area), Lanes(0.0), Lanes(0.0), Lanes(1.0)}, kin, many);
        for (std::size_t k = 0; k < n; ++k) {
            REQUIRE(together.normal[k] == r[k].normal);
            REQUIRE(together.shear[0][k] == r[k].shear[0]);
            REQUIRE(together.damage_work[k] == r[k].damage_work);
            REQUIRE(many.d_t[k] == single[k].d_t);
            REQUIRE(many.u_p[k] == single[k].u_p);
        }
    }
}
