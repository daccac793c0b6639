// What the laboratory reads off a membrane.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "lab/granular.hpp"
#include "lab/membrane.hpp"

using namespace proveta;

namespace {

Deformable membrane_of(const Shape& shape, double edge) {
    MembraneInput input;
    input.element = {edge, ""};
    static const Spheres none;
    static const Material material;
    return make_membrane(input, {shape, none, edge, 1.0, material});
}

} // namespace

TEST_CASE("A membrane encloses the prism of its rings, and what it is blown up or squeezed to", "[membrane]") {
    Shape shape;
    shape.diameter = 0.3;
    shape.height = 0.6;
    Deformable membrane = membrane_of(shape, 0.02);
    // Rings of n corners, turned against each other by half a cell: between two rings the section changes from one polygon to another, all
    // outside the cylinder, which the edges touch, and inside the circle of the corners.
    const double n = std::round(std::numbers::pi * shape.diameter / 0.02);
    const double circle = 0.25 * std::numbers::pi * shape.diameter * shape.diameter * shape.height;
    const double corner = 0.15 / std::cos(std::numbers::pi / n);
    const double volume = enclosed_volume(membrane);
    CHECK(volume > circle);
    CHECK(volume < circle * std::pow(corner / 0.15, 2));
    CHECK(middle_radius(membrane) == Approx(corner).epsilon(1e-12));
    for (auto& p : membrane.solid.position) { // wider by 2 %, shorter by 3 %
        p = Vec3(1.02 * p.x(), 1.02 * p.y(), 0.97 * p.z());
    }
    CHECK(enclosed_volume(membrane) == Approx(1.02 * 1.02 * 0.97 * volume).epsilon(1e-12));
    CHECK(middle_radius(membrane) == Approx(1.02 * corner).epsilon(1e-12));
    for (auto& p : membrane.solid.position) { // moved aside: the volume is the same
        p += Vec3(0.1, -0.2, 0.3);
    }
    CHECK(enclosed_volume(membrane) == Approx(1.02 * 1.02 * 0.97 * volume).epsilon(1e-9));
}

TEST_CASE("A membrane presses with its pressure and goes with the platens", "[membrane]") {
    Shape shape;
    shape.diameter = 0.1;
    shape.height = 0.2;
    Deformable membrane = membrane_of(shape, 0.01);
    Team team(1);
    Solid& solid = membrane.solid;
    solid.pressures.front().value = 1000.0;
    const double dt = 1e-6;
    const double before = enclosed_volume(membrane);
    double work = 0.0;
    for (int k = 0; k < 200; ++k) {
        solid.forces(team);
        work += solid.move(team, dt, k == 0, Vec3::Zero(), {Vec3(0, 0, 0.1), Vec3(0, 0, -0.1)}).pressure;
    }
    // p dV from outside, less what the plane ends, on which the membrane's pressure does not act, sweep: first order in the step, a
    // hundredth of it here.
    const double n = std::round(std::numbers::pi * shape.diameter / 0.01);
    const double corner = 0.05 / std::cos(std::numbers::pi / n);
    const double end = 0.5 * n * corner * corner * std::sin(2.0 * std::numbers::pi / n);
    CHECK(work == Approx(1000.0 * (before - enclosed_volume(membrane) - end * 0.2 * 200 * dt)).epsilon(0.01));
    for (const auto& hold : solid.holds) {
        for (const auto k : hold.node) {
            const double way = hold.platen == 0 ? 0.1 * 200 * dt : -0.1 * 200 * dt;
            CHECK(solid.position[k].z() - solid.mesh().node[k].z() == Approx(way).epsilon(1e-9));
            CHECK(solid.position[k].x() == solid.mesh().node[k].x());
        }
    }
    CHECK(solid.momentum().head<2>().norm() < 1e-9 * solid.mass().front() * 1000.0);
}

TEST_CASE("Only round specimens are wrapped", "[membrane]") {
    Shape shape;
    shape.kind = ShapeKind::prism;
    CHECK_THROWS_AS(membrane_of(shape, 0.01), std::invalid_argument);
}

TEST_CASE("Moduli of a pack follow Walton: the cube root of the pressure, and glass beads as published", "[granular]") {
    Material glass;
    glass.young_modulus = 70e9;
    glass.poisson_ratio = 0.2;
    glass.contact_law = ContactLaw::hertz;
    const PackModuli one = pack_moduli(glass, 0.36, 9.0, 1e6);
    const PackModuli eight = pack_moduli(glass, 0.36, 9.0, 8e6);
    CHECK(eight.bulk == Approx(2.0 * one.bulk).epsilon(1e-12));
    CHECK(eight.shear == Approx(2.0 * one.shear).epsilon(1e-12));
    // Hertz and Mindlin's formula by hand: G = 29.17 GPa, ((0.64 x 9 x 29.17e9)^2 x 1e6 / (18 pi^2 0.64))^(1/3) = 629 MPa.
    CHECK(one.bulk == Approx(629e6).epsilon(0.01));
    // The ratio of shear to bulk modulus depends on nu alone: (5 - 4 nu)/(5 (2 - nu)) 27^(1/3).
    CHECK(one.shear / one.bulk == Approx(4.2 / 9.0 * 3.0).epsilon(1e-12));
}
