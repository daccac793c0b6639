// Spheres and deformable bodies in one calculation: energy, searches, the stable step, checkpoints, exchange of particles, threads.
#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "core/model.hpp"
#include "core/solids/solid_shapes.hpp"
#include "tests/bodies.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

Material grain(double friction, double restitution) {
    Material m;
    m.density = 2000.0;
    m.young_modulus = 1e7;
    m.contact_law = ContactLaw::hertz;
    m.contact_restitution = restitution;
    m.rolling_friction = friction > 0.0 ? 0.02 : 0.0;
    m.mu_d = friction;
    return m;
}

// A soft block or sheet whose upper side is at z = 0, held at its foot or its rim.
Deformable ground(BodyKind kind, Coupling how, const Material& surface, bool held = true, SolidLaw law = SolidLaw::neo_hookean) {
    SolidMaterial m;
    m.law = law;
    m.density = 1000.0;
    m.young_modulus = 1e6;
    m.yield_stress = 2e3;
    m.hardening = 1e5;
    SolidMesh mesh =
        kind == BodyKind::membrane ? sheet_membrane(0.3, 0.3, 10, 10) : box_mesh({0.3, 0.3, 0.1}, 6, 6, 2, kind == BodyKind::tetrahedra);
    for (auto& v : mesh.node) {
        v.z() -= kind == BodyKind::membrane ? 0.0 : 0.05;
    }
    Solid solid("ground", std::move(mesh), m, 0.004);
    for (const auto& g : solid.mesh().groups) {
        if (held && g.name == (kind == BodyKind::membrane ? "rim" : "z-")) {
            solid.holds.push_back({g.name, g.node, {true, true, true}, -1, Vec3::Zero(), Vec3::Zero()});
        }
    }
    return {std::move(solid), surface, surface.mu_d, how, 1.0};
}

Model model_of(Spheres s, std::vector<Deformable> bodies, const Material& m, Numerics numerics) {
    std::vector<double> weight;
    s.packed = false;
    Bonds none = make_bonds(s, {m}, {}, std::vector<std::uint8_t>(s.size(), 0), weight);
    numerics.damping = {0.0, 0.0};
    return {std::move(s), {m}, std::move(none), std::move(weight), Walls({}, {}, std::move(bodies)), numerics};
}

// Spheres that fall side by side and onto each other.
Spheres rain(int layers, double speed) {
    Spheres s;
    std::mt19937 engine(7);
    const auto shift = [&] { return 0.004 * (static_cast<double>(engine()) / 4294967296.0 - 0.5); };
    for (int layer = 0; layer < layers; ++layer) {
        for (int k = 0; k < 25; ++k) {
            s.add({-0.08 + 0.04 * (k % 5) + shift(), -0.08 + 0.04 * (k / 5) + shift(), 0.02 + 0.04 * layer}, 0.016, 2000.0);
            s.velocity.set(s.size() - 1, {0.3, 0.1, -speed});
        }
    }
    return s;
}

Model shower(BodyKind kind, Coupling how, SolidLaw law = SolidLaw::neo_hookean) {
    Numerics numerics;
    numerics.gravity = {0, 0, -9.81};
    numerics.time_step = 5e-5; // stable whatever touches
    numerics.overlap_growth = 2e-4;
    const Material m = grain(0.4, 0.6);
    return model_of(rain(2, 1.0), {ground(kind, how, m, true, law)}, m, numerics);
}

} // namespace

TEST_CASE("coupling: an elastic collision with a soft body keeps its energy") {
    for (const auto kind : kinds) {
        for (const auto how : both) {
            for (const double friction : {0.0, 0.3}) {
                const Material m = grain(friction, 1.0);
                Spheres s;
                s.add({0.013, 0.004, 0.0301}, 0.03, 2000.0);
                s.velocity.set(0, {0.5, 0.2, -1.5});
                Numerics numerics;
                numerics.safety = 0.15;
                Model model = model_of(std::move(s), {ground(kind, how, m)}, m, numerics);
                double worst = 0.0, coupling = 0.0, deepest = 0.0;
                const double kinetic = 0.5 * model.spheres.mass[0] * model.spheres.velocity.at(0).squaredNorm();
                int n = 0;
                while (n < 20000 && (model.spheres.position.at(0).z() < 0.05 || n < 1000)) {
                    model.step({}, true);
                    worst = std::max(worst, std::fabs(model.ledger().residual()));
                    coupling = std::max(coupling, std::fabs(model.ledger().coupling));
                    deepest = std::max(deepest, model.ledger().elastic);
                    ++n;
                }
                INFO("kind " << static_cast<int>(kind) << (how == Coupling::direct ? ", direct" : ", by area") << ", friction " << friction
                             << ": " << n << " steps, residual " << worst / kinetic << ", coupling " << coupling / kinetic);
                CHECK(model.ledger().initial == Approx(kinetic));
                CHECK(deepest > 0.3 * kinetic);
                CHECK(model.spheres.position.at(0).z() > 0.05); // it rebounds
                CHECK(worst < 5e-3 * kinetic);
                CHECK(coupling < (how == Coupling::direct ? 0.02 : 0.05) * kinetic); // that of shares that change
                CHECK(model.walls.bodies[0].sums.crossed == 0);
            }
        }
    }
}

TEST_CASE("coupling: spheres that fall on a body, the ledger closes and threads change no bit") {
    for (const auto kind : kinds) {
        for (const auto how : both) {
            Model one = shower(kind, how, kind == BodyKind::hexahedra ? SolidLaw::j2 : SolidLaw::neo_hookean);
            Model two = shower(kind, how, kind == BodyKind::hexahedra ? SolidLaw::j2 : SolidLaw::neo_hookean);
            one.set_threads(1);
            two.set_threads(2);
            run(one, 1000);
            run(two, 1000);
            CHECK(one.state_hash() == two.state_hash());
            CHECK(one.ledger().coupling == two.ledger().coupling);
            const Ledger& l = one.ledger();
            INFO("given " << l.given() << ", spent " << l.spent() << ", coupling " << l.coupling << ", plastic " << l.plastic);
            CHECK(std::fabs(l.residual()) < 5e-3 * l.initial);
            CHECK(std::fabs(l.coupling) < 2e-2 * l.initial);
            CHECK(one.walls.bodies[0].solid.stored() > 0.01 * l.initial);
            CHECK((kind != BodyKind::hexahedra || l.plastic > 0.0));
        }
    }
}

TEST_CASE("coupling: a model with bodies goes on from a checkpoint bit for bit") {
    const testing::TemporaryFolder folder;
    const std::string file = folder.file("checkpoint.h5");
    for (const auto kind : kinds) {
        const auto law = kind == BodyKind::tetrahedra ? SolidLaw::neo_hookean : SolidLaw::j2;
        for (const int at : {700, 733}) {
            Model straight = shower(kind, Coupling::area_distributed, law);
            run(straight, at);
            testing::save_model(straight, file);
            run(straight, 700);
            Model resumed = shower(kind, Coupling::area_distributed, law);
            testing::load_model(resumed, file);
            run(resumed, 700);
            CHECK(resumed.dt() == straight.dt());
            CHECK(resumed.stable_step() == straight.stable_step());
            CHECK(resumed.searches() == straight.searches());
            CHECK(resumed.state_hash() == straight.state_hash());
            CHECK(resumed.ledger().coupling == straight.ledger().coupling);
            CHECK(resumed.ledger().spent() == straight.ledger().spent());
            CHECK(resumed.ledger().given() == straight.ledger().given());
        }
    }
}

TEST_CASE("coupling: particles come, go and are renumbered over a body") {
    const auto exchange = [](Model& model, bool reversed, const auto& leaves) {
        Spheres spheres;
        spheres.packed = false;
        std::vector<std::int32_t> origin;
        for (std::size_t n = 0; n < model.spheres.size(); ++n) {
            const std::size_t k = reversed ? model.spheres.size() - 1 - n : n;
            if (!leaves(k)) {
                spheres.append(model.spheres, k);
                origin.push_back(static_cast<std::int32_t>(k));
            }
        }
        model.repopulate(std::move(spheres), {}, origin);
    };
    for (const auto kind : kinds) {
        Model straight = shower(kind, Coupling::area_distributed);
        Model turned = shower(kind, Coupling::area_distributed);
        run(straight, 1000);
        run(turned, 500);
        exchange(turned, true, [](std::size_t) { return false; });
        run(turned, 500);
        double apart = 0.0;
        for (std::size_t k = 0; k < 50; ++k) {
            apart = std::max(apart, (straight.spheres.position.at(k) - turned.spheres.position.at(49 - k)).norm());
        }
        CHECK(apart < 1e-7); // round-off through collisions
        CHECK(turned.ledger().initial == Approx(straight.ledger().initial).epsilon(1e-12));
        CHECK(turned.ledger().friction == Approx(straight.ledger().friction).epsilon(1e-5));
        const double residual = turned.ledger().residual(), given = turned.ledger().initial;
        exchange(turned, false, [](std::size_t k) { return k % 3 == 0; });
        run(turned, 1);
        CHECK(turned.ledger().initial < given);
        CHECK(std::fabs(turned.ledger().residual() - residual) < 1e-3 * given);
        run(turned, 500);
        CHECK(std::fabs(turned.ledger().residual()) < 5e-3 * given);
    }
}

TEST_CASE("coupling: no contact is missed, whoever moves") {
    for (const bool body_moves : {false, true}) {
        for (const auto kind : kinds) {
            const auto run_with = [&](double skin, std::int64_t& searches) {
                const Material m = grain(0.4, 0.6);
                Spheres s = rain(1, body_moves ? 0.0 : 2.0);
                if (body_moves) {
                    for (std::size_t k = 0; k < s.size(); ++k) {
                        s.velocity.set(k, Vec3::Zero());
                    }
                }
                Deformable body = ground(kind, Coupling::area_distributed, m, !body_moves);
                for (auto& v : body.solid.velocity) {
                    v.z() = body_moves ? 2.0 : 0.0;
                }
                Numerics numerics;
                numerics.time_step = 2e-5;
                numerics.skin = skin;
                numerics.overlap_growth = 2e-4;
                numerics.fastest = 10.0;
                numerics.refuse_unstable = false; // with such a skin every sphere might touch every node
                Model model = model_of(std::move(s), {std::move(body)}, m, numerics);
                run(model, 1500);
                searches = model.searches();
                return model;
            };
            std::int64_t often = 0, seldom = 0;
            const Model near = run_with(0.02, often);
            const Model far = run_with(10.0, seldom);
            CHECK(seldom == 1);
            double apart = 0.0, gone = 0.0;
            for (std::size_t k = 0; k < near.spheres.size(); ++k) {
                apart = std::max(apart, (near.spheres.position.at(k) - far.spheres.position.at(k)).norm());
                gone = std::max(gone, (near.spheres.position.at(k) - near.spheres.start.at(k)).norm());
            }
            CHECK(gone > 0.01);
            CHECK(apart < 1e-9); // lists in another order: round-off
        }
    }
}

TEST_CASE("coupling: just below the stable step, with many contacts, nothing grows") {
    for (const auto kind : kinds) {
        for (const auto how : both) {
            Material m = grain(0.0, 1.0);
            m.contact_law = ContactLaw::linear;
            m.young_modulus = 1e9; // contacts, not elements, limit the step
            Numerics numerics;
            numerics.safety = 0.999;
            numerics.gravity = {0, 0, -9.81};
            Model model = model_of(rain(1, 0.1), {ground(kind, how, m)}, m, numerics);
            double given = 0.0, spent = 0.0;
            for (int n = 0; n < 3000; ++n) {
                model.step({}, n % 10 == 0);
                given = std::max(given, model.ledger().initial + model.ledger().body);
                spent = std::max(spent, model.ledger().spent());
            }
            INFO("step " << model.dt() << ", spent at most " << spent << " of " << given);
            CHECK(spent < 1.5 * given);
        }
    }
}
