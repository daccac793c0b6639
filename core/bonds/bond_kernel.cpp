// The bond loop. Compiled once per instruction set; PROVETA_VARIANT names the variant's entry point.
#include "core/bonds/bond_kernel.hpp"

#include "core/geometry/lanes.hpp"
#include "core/parallel/variant.hpp"

namespace proveta {

namespace {

// The laws under one name, for the loop.
struct Dempack {
    template <class... Args> PROVETA_INLINE static auto advance(Args&&... args) { return dempack::advance(args...); }
    template <class... Args> PROVETA_INLINE static auto stored_energy(Args&&... args) { return dempack::stored_energy(args...); }
    template <class... Args> PROVETA_INLINE static auto failure_criterion(Args&&... args) { return dempack::failure_criterion(args...); }
};
struct Released {
    template <class... Args> PROVETA_INLINE static auto advance(Args&&... args) { return released::advance(args...); }
    template <class... Args> PROVETA_INLINE static auto stored_energy(Args&&... args) { return released::stored_energy(args...); }
    template <class... Args> PROVETA_INLINE static auto failure_criterion(Args&&... args) { return released::failure_criterion(args...); }
};

// Bending and twisting of the group at b; stays: share of the stiffness that damage has left, before and after the step. Returns the stored
// energy; what damage takes of it goes to `lost`.
// The moment of j on i goes to `couple`.
template <class T>
PROVETA_INLINE T bond_moments(const BondView& bonds, const BondLaw& law, std::size_t b, const PairKinematics<T>& pair, const T& k_n,
                              const T& area, const T& stayed, const T& stays, T (&couple)[3], T& lost) {
    T theta[3];
    T axis[3]; // rotation of the bond's frame in the step: n x change of n, and the spin about n
    T old[3];
    T next[3];
    for (int c = 0; c < 3; ++c) {
        const int p = (c + 1) % 3;
        const int q = (c + 2) % 3;
        theta[c] = load<T>(&bonds.rotation[c][b]);
        axis[c] = pair.n[p] * pair.turn[q] - pair.n[q] * pair.turn[p] + pair.twist * pair.n[c];
    }
    T first[3];
    for (int c = 0; c < 3; ++c) {
        first[c] = axis[(c + 1) % 3] * theta[(c + 2) % 3] - axis[(c + 2) % 3] * theta[(c + 1) % 3];
    }
    for (int c = 0; c < 3; ++c) {
        const T second = axis[(c + 1) % 3] * first[(c + 2) % 3] - axis[(c + 2) % 3] * first[(c + 1) % 3];
        old[c] = theta[c] + first[c] + 0.5 * second;
        next[c] = select(stays > T(0.0), old[c] + pair.rolled[c], T(0.0));
    }
    const T bend = law.bending_stiffness(k_n, area);
    const T twist = law.twisting_stiffness(k_n, area);
    const T old_n = old[0] * pair.n[0] + old[1] * pair.n[1] + old[2] * pair.n[2];
    const T next_n = next[0] * pair.n[0] + next[1] * pair.n[1] + next[2] * pair.n[2];
    T stored = T(0.0);
    T crossed = T(0.0); // energy product of before and after, as for the springs
    for (int c = 0; c < 3; ++c) {
        const T moment = bend * (next[c] - next_n * pair.n[c]) + twist * next_n * pair.n[c];
        const T kept = old[c] + pair.rolled[c];
        const T before = bend * (old[c] - old_n * pair.n[c]) + twist * old_n * pair.n[c];
        stored = stored + 0.5 * stays * moment * next[c];
        crossed = crossed + 0.5 * before * kept;
        store(&bonds.rotation[c][b], next[c]);
        couple[c] = stays * moment;
        store(&bonds.couple[c][b], couple[c]);
    }
    lost = crossed * (stayed - stays);
    return stored;
}

// Share of the stiffness against moments that damage has left.
template <class T> PROVETA_INLINE T intact(const T& d_n, const T& d_t) {
    using std::max;
    return T(1.0) - max(d_n, d_t);
}

// Whether the group may have a history of plastic shortening or damage, and that it has one from now on.
template <class T> PROVETA_INLINE bool any_worn(const std::uint8_t* worn) {
    std::uint8_t some = 0;
    for (std::size_t k = 0; k < lane_count<T>(); ++k) {
        some |= worn[k];
    }
    return some != 0;
}
template <class T> PROVETA_INLINE void wear(std::uint8_t* worn) {
    for (std::size_t k = 0; k < lane_count<T>(); ++k) {
        worn[k] = 1;
    }
}

// One group of lane_count<T>() bonds starting at b.
template <class Law, class T, bool damped, bool moments, bool measure>
PROVETA_INLINE void bond_group(const SphereView& s, const BondView& bonds, const BondLaw& law, double* rows, std::size_t begin,
                               std::size_t b, double dt, RunResult& out) {
    using std::sqrt;
    const T u[3] = {load<T>(&bonds.slip[0][b]), load<T>(&bonds.slip[1][b]), load<T>(&bonds.slip[2][b])};
    const T share = load<T>(&bonds.share[b]);
    const auto pair = pair_kinematics(s, &bonds.i[b], &bonds.j[b], share, u, dt);

    dempack::Kinematics<T> kin;
    kin.shortening = load<T>(&bonds.length[b]) - pair.distance;
    kin.approach = -pair.separation * dt;
    const T moved = kin.approach; // of the spheres themselves
    if (bonds.shift != nullptr) {
        const T shift = load<T>(&bonds.shift[b]);
        kin.shortening = kin.shortening - shift;
        kin.approach = kin.approach - (shift - load<T>(&bonds.shift_before[b]));
    }
    dempack::State<T> state;
    for (int c = 0; c < 3; ++c) {
        kin.slip[c] = pair.slip[c];
        state.u_t[c] = pair.turned[c];
    }
    state.u_p = state.d_n = state.d_t = T(0.0);
    if (any_worn<T>(&bonds.worn[b])) {
        state.u_p = load<T>(&bonds.plastic[b]);
        state.d_n = load<T>(&bonds.damage_n[b]);
        state.d_t = load<T>(&bonds.damage_t[b]);
    }
    const T u_p_old = state.u_p;
    const T d_n_old = state.d_n;
    const T d_t_old = state.d_t;

    const T k_n = load<T>(&bonds.stiffness[b]);
    const T area = load<T>(&bonds.area[b]);
    auto r = Law::advance(law, k_n, area, kin, state);

    T normal = r.normal;
    const auto broken = (state.d_n >= T(1.0)) || (state.d_t >= T(1.0));
    if constexpr (damped) {
        // Dashpot; once the bond has failed it acts only in contact and never pulls.
        const T viscous = load<T>(&bonds.dashpot[b]) * -pair.separation;
        const T bounded = select(r.normal > T(0.0), select(r.normal + viscous > T(0.0), viscous, -r.normal), T(0.0));
        const T dashpot = select(broken, bounded, viscous);
        normal = normal + dashpot;
        const T lost = dashpot * moved;
        for (std::size_t k = 0; k < lane_count<T>(); ++k) {
            out.dissipation.dashpot += in_lane(lost, k);
        }
    }

    T in_moments = T(0.0);
    T couple[3] = {T(0.0), T(0.0), T(0.0)};
    if constexpr (moments) {
        T lost;
        in_moments = bond_moments(bonds, law, b, pair, k_n, area, intact(d_n_old, d_t_old), intact(state.d_n, state.d_t), couple, lost);
        r.damage_work = r.damage_work + lost;
    }

    const auto force = add_pair_loads(rows, &bonds.i[b], &bonds.row_j[b], pair, share, normal, r.shear, couple);
    for (int c = 0; c < 3; ++c) {
        store(&bonds.slip[c][b], state.u_t[c]);
    }

    if (any_of(r.plastic_work != T(0.0)) || any_of(state.u_p != u_p_old)) {
        wear<T>(&bonds.worn[b]);
        store(&bonds.plastic[b], state.u_p);
        for (std::size_t k = 0; k < lane_count<T>(); ++k) {
            out.dissipation.plastic += in_lane(r.plastic_work, k);
        }
    }
    if (any_of(r.friction_work != T(0.0))) {
        for (std::size_t k = 0; k < lane_count<T>(); ++k) {
            out.dissipation.friction += in_lane(r.friction_work, k);
        }
    }
    if (any_of(state.d_n > d_n_old) || any_of(state.d_t > d_t_old) || any_of(r.damage_work != T(0.0))) {
        wear<T>(&bonds.worn[b]);
        store(&bonds.damage_n[b], state.d_n);
        store(&bonds.damage_t[b], state.d_t);
        for (std::size_t k = 0; k < lane_count<T>(); ++k) {
            const double work = in_lane(r.damage_work, k);
            out.dissipation.damage += work;
            bonds.damage_work[b + k] += work;
            if (mask_lane(broken, k) && bonds.mode[b + k] == 0) {
                bonds.mode[b + k] = in_lane(state.d_n, k) >= 1.0 ? 1 : 2; // FailureMode: tension, shear
                bonds.failures[begin + out.failed++] = static_cast<std::uint32_t>(b + k);
            }
        }
    }
    if constexpr (measure) {
        const T shear = sqrt(r.shear[0] * r.shear[0] + r.shear[1] * r.shear[1] + r.shear[2] * r.shear[2]);
        for (int c = 0; c < 3; ++c) {
            store(&bonds.force[c][b], force.x[c]);
        }
        store(&bonds.normal[b], r.normal);
        store(&bonds.shear[b], shear);
        store(&bonds.criterion[b], Law::failure_criterion(law, k_n, area, kin.shortening, r.normal, shear, state));
        store(&bonds.stored[b], Law::stored_energy(law, k_n, kin.shortening, r.normal, state) + in_moments);
    }
}

template <class Law, bool damped, bool moments, bool measure>
void run(const SphereView& s, const BondView& bonds, const BondLaw& law, double* rows, std::size_t begin, std::size_t end, double dt,
         RunResult& out) {
    std::size_t b = begin;
    for (; b + lane_count<Lanes>() <= end; b += lane_count<Lanes>()) {
        bond_group<Law, Lanes, damped, moments, measure>(s, bonds, law, rows, begin, b, dt, out);
    }
    for (; b < end; ++b) {
        bond_group<Law, double, damped, moments, measure>(s, bonds, law, rows, begin, b, dt, out);
    }
}

} // namespace

void PROVETA_VARIANT(bond_kernel)(const SphereView& s, const BondView& bonds, const BondLaw& law, double* rows, std::size_t begin,
                                  std::size_t end, double dt, bool measure, RunResult& out) {
    out = {};
    const auto pick = [&](auto* measured, auto* unmeasured) {
        (measure ? measured : unmeasured)(s, bonds, law, rows, begin, end, dt, out);
    };
    // Rare variants take dashpots along, which cost them little.
    if (law.kind == LawKind::released) {
        pick(run<Released, true, false, true>, run<Released, true, false, false>);
    } else if (law.has_moments()) {
        pick(run<Dempack, true, true, true>, run<Dempack, true, true, false>);
    } else if (bonds.damped) {
        pick(run<Dempack, true, false, true>, run<Dempack, true, false, false>);
    } else {
        pick(run<Dempack, false, false, true>, run<Dempack, false, false, false>);
    }
}

} // namespace proveta
