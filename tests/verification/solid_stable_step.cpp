// The stable step of deformable bodies against eigenvalues of their stiffness.
#include <catch2/catch.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "tests/bodies.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

// The largest stable step by eigenvalues of the tangent stiffness, by differences of the forces.
double true_step(Solid& s) {
    Team team(1);
    const auto n = static_cast<Eigen::Index>(3 * s.nodes());
    Eigen::MatrixXd k(n, n);
    const auto from = s.position;
    for (Eigen::Index c = 0; c < n; ++c) {
        Eigen::VectorXd f[2];
        for (int side = 0; side < 2; ++side) {
            constexpr double h = 1e-7;
            s.position[static_cast<std::size_t>(c / 3)][c % 3] = from[static_cast<std::size_t>(c / 3)][c % 3] + (side == 0 ? h : -h);
            s.forces(team);
            const auto forces = s.element_forces();
            f[side] = Eigen::Map<const Eigen::VectorXd>(forces[0].data(), n) / (2.0 * h);
            s.position = from;
        }
        k.col(c) = f[1] - f[0];
    }
    s.forces(team);
    for (Eigen::Index r = 0; r < n; ++r) {
        for (Eigen::Index c = 0; c < n; ++c) {
            k(r, c) /= std::sqrt(s.mass()[static_cast<std::size_t>(r / 3)] * s.mass()[static_cast<std::size_t>(c / 3)]);
        }
    }
    const double w2 = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (k + k.transpose())).eigenvalues().maxCoeff();
    const double damping = s.material.mass_damping + s.material.stiffness_damping * w2;
    return 4.0 / (damping + std::sqrt(damping * damping + 4.0 * w2));
}

} // namespace

TEST_CASE("solids: the bound on the step is below the true limit, and near it for regular meshes") {
    Dice dice(3);
    for (const double nu : {0.0, 0.3, 0.45}) {
        for (int kind = 0; kind < 3; ++kind) {
            for (const bool regular : {true, false}) {
                SolidMaterial m = soft_solid(SolidLaw::neo_hookean);
                m.poisson_ratio = nu;
                m.mass_damping = regular ? 0.0 : 100.0;
                SolidMesh mesh = kind == 2 ? sheet_membrane(0.3, 0.3, 4, 4) : box_mesh({0.3, 0.3, 0.3}, 3, 3, 3, kind == 0);
                for (auto& v : mesh.node) {
                    v += regular ? Vec3::Zero() : dice.in_box(0.02);
                }
                Solid s = solid_of(mesh, m);
                const double ratio = true_step(s) / stable(s);
                INFO("kind " << kind << ", nu " << nu << ", regular " << regular);
                CHECK(ratio >= 1.0);
                CHECK((!regular || ratio < 2.0));
            }
        }
    }
}

TEST_CASE("solids: the bound holds for bodies that are strongly deformed") {
    Dice dice(4);
    for (const auto law : {SolidLaw::kirchhoff, SolidLaw::neo_hookean, SolidLaw::j2}) {
        for (int kind = 0; kind < 3; ++kind) {
            double lowest = 1e300;
            for (int n = 0; n < 30; ++n) {
                SolidMaterial m = soft_solid(law);
                m.poisson_ratio = n % 2 == 0 ? 0.2 : 0.45;
                SolidMesh mesh = kind == 2 ? sheet_membrane(0.2, 0.2, 2, 2) : box_mesh({0.2, 0.2, 0.2}, 2, 2, 2, kind == 0);
                Solid s = solid_of(mesh, m);
                Vec3 stretch(dice(0.5, 1.7), dice(0.5, 1.7), dice(0.5, 1.7));
                if (law == SolidLaw::j2) { // large strains of metals are plastic
                    stretch *= dice(0.95, 1.05) / std::cbrt(stretch.prod());
                }
                const Mat3 turn = Eigen::AngleAxisd(dice(0, 3), dice.in_box(1.0).normalized()).toRotationMatrix();
                const Mat3 to = law == SolidLaw::kirchhoff ? Mat3(turn * Vec3(0.85 + 0.3 * stretch.array()).asDiagonal())
                                                           : Mat3(turn * stretch.asDiagonal() * turn.transpose());
                Team team(1);
                for (int step = 1; step <= 20; ++step) {
                    for (std::size_t k = 0; k < s.nodes(); ++k) {
                        s.position[k] = (Mat3::Identity() + step / 20.0 * (to - Mat3::Identity())) * s.mesh().node[k];
                    }
                    s.forces(team);
                }
                lowest = std::min(lowest, true_step(s) / stable(s));
            }
            INFO("law " << static_cast<int>(law) << ", kind " << kind << ": true step over bound at least " << lowest);
            CHECK(lowest >= 1.0);
        }
    }
}

TEST_CASE("solids: just below the bound a body stays bounded for ever") {
    Dice dice(5);
    for (int kind = 0; kind < 3; ++kind) {
        SolidMaterial m = soft_solid(SolidLaw::neo_hookean);
        m.stiffness_damping = kind == 1 ? 1e-4 : 0.0;
        SolidMesh mesh = kind == 2 ? sheet_membrane(0.3, 0.3, 4, 4) : box_mesh({0.3, 0.3, 0.3}, 3, 3, 3, kind == 0);
        for (auto& v : mesh.node) {
            v += dice.in_box(0.01);
        }
        Solid s = solid_of(mesh, m);
        for (auto& v : s.velocity) {
            v = dice.in_box(1e-3);
        }
        Run run{s};
        run.dt = 0.999 * stable(s);
        run.step();
        const double initial = run.energy();
        double largest = 0.0;
        for (int n = 0; n < 5000; ++n) {
            run.step();
            largest = std::max(largest, s.stored());
        }
        CHECK(largest < 10.0 * initial);
    }
}
