// The bond loop. Compiled once per instruction set; PROVETA_BOND_KERNEL is the name of the variant's entry point.
#include "core/bonds/bond_kernel.hpp"

#include "core/geometry/lanes.hpp"

namespace proveta {

namespace {

// One group of lane_count<T>() bonds starting at b.
template <class T, bool damped, bool measure>
inline void bond_group(const SphereView& s, const BondView& bonds, const dempack::Parameters& law, std::size_t b, double dt,
                       BlockResult& out) {
    using std::sqrt;
    const T u[3] = {load<T>(&bonds.slip[0][b]), load<T>(&bonds.slip[1][b]), load<T>(&bonds.slip[2][b])};
    const auto pair = pair_kinematics(s, &bonds.i[b], &bonds.j[b], load_shares<T>(&bonds.forces[b]), u, dt);

    dempack::Kinematics<T> kin;
    kin.shortening = load<T>(&bonds.length[b]) - pair.distance;
    kin.approach = -pair.separation * dt;
    dempack::State<T> state;
    for (int c = 0; c < 3; ++c) {
        kin.slip[c] = pair.slip[c];
        state.u_t[c] = pair.turned[c];
    }
    state.u_p = load<T>(&bonds.plastic[b]);
    state.d_n = load<T>(&bonds.damage_n[b]);
    state.d_t = load<T>(&bonds.damage_t[b]);
    const T d_n_old = state.d_n;
    const T d_t_old = state.d_t;

    const T k_n = load<T>(&bonds.stiffness[b]);
    const T area = load<T>(&bonds.area[b]);
    const auto r = dempack::advance(law, k_n, area, kin, state);

    T normal = r.normal;
    const auto broken = (state.d_n >= T(1.0)) || (state.d_t >= T(1.0));
    if constexpr (damped) {
        // Dashpot; once the bond has failed it acts only in contact and never pulls.
        const T viscous = load<T>(&bonds.dashpot[b]) * -pair.separation;
        const T bounded = select(r.normal > T(0.0), select(r.normal + viscous > T(0.0), viscous, -r.normal), T(0.0));
        const T dashpot = select(broken, bounded, viscous);
        normal = normal + dashpot;
        const T lost = dashpot * kin.approach;
        for (std::size_t k = 0; k < lane_count<T>(); ++k) {
            out.dissipation.dashpot += in_lane(lost, k);
        }
    }

    store_pair_forces(&bonds.forces[b], pair, normal, r.shear);
    for (int c = 0; c < 3; ++c) {
        store(&bonds.slip[c][b], state.u_t[c]);
    }

    if (any_of(r.plastic_work != T(0.0)) || any_of(state.u_p != load<T>(&bonds.plastic[b]))) {
        store(&bonds.plastic[b], state.u_p);
        for (std::size_t k = 0; k < lane_count<T>(); ++k) {
            out.dissipation.plastic += in_lane(r.plastic_work, k);
        }
    }
    if (any_of(broken)) {
        for (std::size_t k = 0; k < lane_count<T>(); ++k) {
            out.dissipation.friction += in_lane(r.friction_work, k);
        }
    }
    if (any_of(state.d_n > d_n_old) || any_of(state.d_t > d_t_old) || any_of(r.damage_work != T(0.0))) {
        store(&bonds.damage_n[b], state.d_n);
        store(&bonds.damage_t[b], state.d_t);
        for (std::size_t k = 0; k < lane_count<T>(); ++k) {
            const double work = in_lane(r.damage_work, k);
            out.dissipation.damage += work;
            bonds.damage_work[b + k] += work;
            if (mask_lane(broken, k) && bonds.mode[b + k] == 0) {
                bonds.mode[b + k] = in_lane(state.d_n, k) >= 1.0 ? 1 : 2; // FailureMode: tension, shear
                out.failures[out.failed++] = static_cast<std::uint32_t>(b + k);
            }
        }
    }
    if constexpr (measure) {
        const T shear = sqrt(r.shear[0] * r.shear[0] + r.shear[1] * r.shear[1] + r.shear[2] * r.shear[2]);
        store(&bonds.normal[b], r.normal);
        store(&bonds.shear[b], shear);
        store(&bonds.criterion[b], dempack::failure_criterion(law, k_n, area, kin.shortening, r.normal, shear, state));
        store(&bonds.stored[b], dempack::stored_energy(law, k_n, kin.shortening, r.normal, state));
    }
}

template <bool damped, bool measure>
void run(const SphereView& s, const BondView& bonds, const dempack::Parameters& law, std::size_t begin, std::size_t end, double dt,
         BlockResult& out) {
    std::size_t b = begin;
    for (; b + lane_count<Lanes>() <= end; b += lane_count<Lanes>()) {
        bond_group<Lanes, damped, measure>(s, bonds, law, b, dt, out);
    }
    for (; b < end; ++b) {
        bond_group<double, damped, measure>(s, bonds, law, b, dt, out);
    }
}

} // namespace

void PROVETA_BOND_KERNEL(const SphereView& s, const BondView& bonds, const dempack::Parameters& law, std::size_t begin, std::size_t end,
                         double dt, bool measure, BlockResult& out) {
    out.dissipation = {};
    out.failed = 0;
    if (bonds.damped) {
        measure ? run<true, true>(s, bonds, law, begin, end, dt, out) : run<true, false>(s, bonds, law, begin, end, dt, out);
    } else {
        measure ? run<false, true>(s, bonds, law, begin, end, dt, out) : run<false, false>(s, bonds, law, begin, end, dt, out);
    }
}

} // namespace proveta
