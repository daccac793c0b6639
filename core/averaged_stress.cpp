#include "core/averaged_stress.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace proveta {

namespace {

// Sum over a sphere's pairs of branch x force: the branch of i is share_i (x_j - x_i), that of j points the other way, as does its force.
template <class Pairs> void add_pairs(const Spheres& s, const Pairs& pairs, std::size_t sphere, Mat3& sum) {
    const auto& in = pairs.incidence;
    for (auto e = in.offset[sphere]; e < in.offset[sphere + 1]; ++e) {
        const auto p = in.entry[e] >> 1;
        const double share = (in.entry[e] & 1u) != 0 ? 1.0 - pairs.share[p] : pairs.share[p];
        const Vec3 to = s.position.at(static_cast<std::size_t>(pairs.j[p])) - s.position.at(static_cast<std::size_t>(pairs.i[p]));
        sum -= share * to * pairs.force.at(p).transpose();
    }
}

} // namespace

std::vector<Mat3> sphere_stresses(const Spheres& s, const Bonds& bonds, const Contacts& contacts, const Walls& walls,
                                  const std::vector<Pressure>& pressures, const std::vector<double>& volume) {
    std::vector<Mat3> sum(s.size(), Mat3::Zero());
    for (const auto& platen : walls.platens) {
        for (std::size_t k = 0; k < platen.sphere.size(); ++k) {
            const auto i = static_cast<std::size_t>(platen.sphere[k]);
            const auto foot = platen.foot(s.position.at(i));
            const Vec3 arm = -foot.distance * foot.normal;
            sum[i] -= arm * platen.force.at(k).transpose();
        }
    }
    for (const auto& surface : walls.surfaces) {
        for (const auto& touches : surface.touches) {
            for (const auto& t : touches) {
                const auto i = static_cast<std::size_t>(t.sphere);
                sum[i] -= (surface.to_space(t.point) - s.position.at(i)) * t.force.transpose();
            }
        }
    }
    for (const auto& body : walls.bodies) {
        for (const auto& touches : body.touches) {
            for (const auto& t : touches) {
                const auto i = static_cast<std::size_t>(t.sphere);
                sum[i] -= (t.point - s.position.at(i)) * t.force.transpose();
            }
        }
    }
    for (const auto& pressure : pressures) {
        for (std::size_t k = 0; k < pressure.force.size(); ++k) {
            const auto i = static_cast<std::size_t>(pressure.sphere[k]);
            const Vec3 force = pressure.force.at(k);
            sum[i] += s.radius[i] * force.normalized() * force.transpose(); // it acts at the foot of the sphere, against the force
        }
    }
#pragma omp parallel for schedule(static)
    for (std::size_t k = 0; k < s.size(); ++k) {
        add_pairs(s, bonds, k, sum[k]);
        if (contacts.size() > 0) {
            add_pairs(s, contacts, k, sum[k]);
        }
        sum[k] = (0.5 / volume[k]) * (sum[k] + sum[k].transpose()).eval();
    }
    return sum;
}

std::vector<Mat3> vicinity_stresses(const Bonds& bonds, const std::vector<Mat3>& stress, const std::vector<double>& volume) {
    std::vector<Mat3> out(stress.size());
    const auto& in = bonds.incidence;
#pragma omp parallel for schedule(static)
    for (std::size_t k = 0; k < stress.size(); ++k) {
        Mat3 sum = volume[k] * stress[k];
        double whole = volume[k];
        for (auto e = in.offset[k]; e < in.offset[k + 1]; ++e) {
            const auto b = in.entry[e] >> 1;
            if (bonds.mode[b] == 0) {
                const auto other = static_cast<std::size_t>((in.entry[e] & 1u) != 0 ? bonds.i[b] : bonds.j[b]);
                sum += volume[other] * stress[other];
                whole += volume[other];
            }
        }
        out[k] = sum / whole;
    }
    return out;
}

namespace {

// Principal values in ascending order by the closed form: a step asks for one set a bond.
Vec3 principal_values(const Mat3& stress) {
    Eigen::SelfAdjointEigenSolver<Mat3> solver;
    return solver.computeDirect(stress, Eigen::EigenvaluesOnly).eigenvalues();
}

double tension_use(double lowest, double sigma_f) { return std::max(-lowest, 0.0) / std::max(sigma_f, smallest); }

// tau / (c + mu sigma) over the planes of Mohr's circle has its maximum t / sqrt(a^2 - (mu t)^2), a = c + mu s.
double shear_use(const Vec3& principal, double cohesion, double mu) {
    const double radius = 0.5 * (principal[2] - principal[0]);
    const double centre = cohesion + 0.5 * mu * (principal[2] + principal[0]);
    const double left = centre * centre - mu * mu * radius * radius;
    return radius <= 0.0 ? 0.0 : centre > 0.0 && left > 0.0 ? radius / std::sqrt(left) : 1e300;
}

} // namespace

double mohr_coulomb(const Mat3& stress, double cohesion, double mu, double sigma_f) {
    const Vec3 principal = principal_values(stress);
    return std::max(shear_use(principal, cohesion, mu), tension_use(principal[0], sigma_f));
}

double rankine(const Mat3& stress, double sigma_f) { return tension_use(principal_values(stress)[0], sigma_f); }

void averaged_criteria(const Bonds& b, const std::vector<Mat3>& stress, std::vector<double>& value,
                       std::vector<std::uint8_t>& shear_governs) {
    value.resize(b.size());
    shear_governs.assign(b.size(), 0);
    for (const auto& block : b.blocks) {
        const AveragedCriterion& criterion = b.groups[block.group].criterion;
        if (criterion.kind == Criterion::bond) {
            continue;
        }
#pragma omp parallel for schedule(static)
        for (std::size_t k = block.begin; k < block.end; ++k) {
            if (b.mode[k] != 0) {
                value[k] = 1.0;
                continue;
            }
            const Mat3 mean = 0.5 * (stress[static_cast<std::size_t>(b.i[k])] + stress[static_cast<std::size_t>(b.j[k])]);
            const Vec3 principal = principal_values(mean);
            const double tension = tension_use(principal[0], criterion.sigma_f);
            const double shear = criterion.kind == Criterion::mohr_coulomb ? shear_use(principal, criterion.tau_f, criterion.mu_s) : 0.0;
            value[k] = std::max(shear, tension);
            shear_governs[k] = shear > tension ? 1 : 0;
        }
    }
}

double fail_bond(const Spheres& s, Bonds& b, std::size_t bond, const BondGroup& group, FailureMode mode, double dt, Loads& loads) {
    const auto i = static_cast<std::size_t>(b.i[bond]);
    const auto j = static_cast<std::size_t>(b.j[bond]);
    const Vec3 to = s.position.at(j) - s.position.at(i);
    const double d = to.norm();
    const Vec3 n = to / d;
    const double k_n = b.stiffness[bond];
    double elongation = d - (b.length[bond] - b.plastic()[bond]);
    double before = elongation - (s.velocity.at(j) - s.velocity.at(i)).dot(n) * dt;
    if (b.dilatation.active()) {
        elongation += b.dilatation.shift[bond];
        before += b.dilatation.shift_before[bond];
    }
    const Vec3 slip = b.slip.at(bond);
    const Vec3 force = b.force.at(bond);
    const double work_n = 0.5 * k_n * std::max(elongation, 0.0) * std::max(before, 0.0);
    double work = work_n + 0.5 * k_n * group.shear_ratio() * slip.squaredNorm();
    Vec3 couple = Vec3::Zero();
    if (b.moments) {
        couple = b.couple.at(bond);
        work += 0.5 * b.couple.at(bond).dot(b.rotation.at(bond));
        b.couple.set(bond, Vec3::Zero());
        b.rotation.set(bond, Vec3::Zero());
    }
    const Vec3 left = elongation > 0.0 ? Vec3::Zero().eval() : Vec3(n * n.dot(force));
    // The loads have the bond's force already: put what is left in its place.
    const Vec3 moment = to.cross(left - force);
    loads.add(i, left - force, b.share[bond] * moment - couple);
    loads.add(j, force - left, (1.0 - b.share[bond]) * moment + couple);
    b.force.set(bond, left);
    b.slip.set(bond, Vec3::Zero());
    std::visit(
        [&](const auto& c) {
            using Law = LawOf<decltype(c)>;
            auto state = b.state<Law>(bond);
            Law::fail(state, mode);
            b.set_state<Law>(bond, state);
        },
        group.law);
    b.mode[bond] = static_cast<std::uint8_t>(mode);
    b.worn[bond] = 1;
    b.damage_work[bond] += work;
    b.normal[bond] = std::max(b.normal[bond], 0.0);
    b.shear[bond] = 0.0;
    b.stored[bond] = b.normal[bond] * b.normal[bond] / (2.0 * k_n);
    return work;
}

} // namespace proveta
