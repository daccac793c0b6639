// The bond loop. Compiled once per instruction set; PROVETA_VARIANT names the variant's entry point.
#include "core/bonds/bond_kernel.hpp"

#include "core/geometry/lanes.hpp"
#include "core/parallel/variant.hpp"

namespace proveta {

namespace {

// Bending and twisting of the group at b; stays: share of the stiffness that damage has left, before and after the step. Returns the stored
// energy; what damage takes of it goes to `lost`.
// The moment of j on i goes to `couple`.
template <class T>
PROVETA_INLINE T bond_moments(const BondView& bonds, const BondBeams& beams, std::size_t b, const PairKinematics<T>& pair, const T& k_n,
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
    const T bend = beams.bending_stiffness(k_n, area);
    const T twist = beams.twisting_stiffness(k_n, area);
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
PROVETA_INLINE void bond_group(const SphereView& s, const BondView& bonds, const typename Law::Constants& law, const BondBeams& beams,
                               double* rows, std::size_t begin, std::size_t b, double dt, RunResult& out) {
    using std::sqrt;
    const T u[3] = {load<T>(&bonds.slip[0][b]), load<T>(&bonds.slip[1][b]), load<T>(&bonds.slip[2][b])};
    const T share = load<T>(&bonds.share[b]);
    const auto pair = pair_kinematics(s, &bonds.i[b], &bonds.j[b], share, u, dt);

    BondShape<T> bond;
    bond.length = load<T>(&bonds.length[b]);
    BondMotion<T> kin;
    kin.shortening = bond.length - pair.distance;
    kin.approach = -pair.separation * dt;
    const T moved = kin.approach; // of the spheres themselves
    if (bonds.shift != nullptr) {
        const T shift = load<T>(&bonds.shift[b]);
        kin.shortening = kin.shortening - shift;
        kin.approach = kin.approach - (shift - load<T>(&bonds.shift_before[b]));
    }
    typename Law::template State<T> state;
    for (int c = 0; c < 3; ++c) {
        kin.slip[c] = pair.slip[c];
        state.u_t[c] = pair.turned[c];
    }
    const bool remembers = any_worn<T>(&bonds.worn[b]);
    std::size_t m = 0;
    T memory[bond_memory];
    Law::members(state, [&](const char*, T& x) {
        memory[m] = remembers ? load<T>(&bonds.memory[m][b]) : T(0.0);
        x = memory[m++];
    });
    [[maybe_unused]] const T stayed = Law::intact(state);

    bond.k_n = load<T>(&bonds.stiffness[b]);
    bond.area = load<T>(&bonds.area[b]);
    bond.volumetric = T(0.0);
    bond.strength = bonds.strength != nullptr ? load<T>(&bonds.strength[b]) : T(1.0);
    if constexpr (Law::asks_volumetric_strain) {
        if (bonds.volumetric != nullptr && Law::beyond_yield(law, bond, kin, state)) {
            bond.volumetric = 0.5 * (gather<T>(bonds.volumetric, &bonds.i[b]) + gather<T>(bonds.volumetric, &bonds.j[b]));
        }
    }
    auto r = Law::advance(law, bond, kin, state);

    T normal = r.normal;
    const auto broken = Law::failed(state);
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
        in_moments = bond_moments(bonds, beams, b, pair, bond.k_n, bond.area, stayed, Law::intact(state), couple, lost);
        r.damage_work = r.damage_work + lost;
    }

    const auto force = add_pair_loads(rows, &bonds.i[b], &bonds.row_j[b], pair, share, normal, r.shear, couple);
    for (int c = 0; c < 3; ++c) {
        store(&bonds.slip[c][b], state.u_t[c]);
    }

    m = 0;
    auto changed = (r.plastic_work != T(0.0)) || (r.damage_work != T(0.0));
    Law::members(state, [&](const char*, const T& x) { changed = changed || (x != memory[m++]); });
    if (any_of(r.friction_work != T(0.0))) {
        for (std::size_t k = 0; k < lane_count<T>(); ++k) {
            out.dissipation.friction += in_lane(r.friction_work, k);
        }
    }
    if (any_of(changed)) {
        wear<T>(&bonds.worn[b]);
        m = 0;
        Law::members(state, [&](const char*, const T& x) { store(&bonds.memory[m++][b], x); });
        store(&bonds.damage_work[b], T(load<T>(&bonds.damage_work[b]) + r.damage_work));
        for (std::size_t k = 0; k < lane_count<T>(); ++k) {
            out.dissipation.plastic += in_lane(r.plastic_work, k);
            out.dissipation.damage += in_lane(r.damage_work, k);
        }
        if (any_of(broken)) {
            const auto in_shear = Law::failed_in_shear(state);
            for (std::size_t k = 0; k < lane_count<T>(); ++k) {
                if (mask_lane(broken, k) && bonds.mode[b + k] == 0) {
                    bonds.mode[b + k] = static_cast<std::uint8_t>(mask_lane(in_shear, k) ? FailureMode::shear : FailureMode::tension);
                    bonds.failures[begin + out.failed++] = static_cast<std::uint32_t>(b + k);
                }
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
        store(&bonds.criterion[b], Law::failure_criterion(law, bond, kin, r.normal, shear, state));
        store(&bonds.stored[b], Law::stored_energy(law, bond, kin, r.normal, state) + in_moments);
    }
}

template <class Law, bool damped, bool moments, bool measure>
void run(const SphereView& s, const BondView& bonds, const void* law, const BondBeams& beams, double* rows, std::size_t begin,
         std::size_t end, double dt, RunResult& out) {
    const auto& constants = *static_cast<const typename Law::Constants*>(law);
    std::size_t b = begin;
    for (; b + lane_count<Lanes>() <= end; b += lane_count<Lanes>()) {
        bond_group<Law, Lanes, damped, moments, measure>(s, bonds, constants, beams, rows, begin, b, dt, out);
    }
    for (; b < end; ++b) {
        bond_group<Law, double, damped, moments, measure>(s, bonds, constants, beams, rows, begin, b, dt, out);
    }
}

template <class Law>
void kernel(const SphereView& s, const BondView& bonds, const void* law, const BondBeams& beams, double* rows, std::size_t begin,
            std::size_t end, double dt, bool measure, RunResult& out) {
    out = {};
    const auto pick = [&](auto* measured, auto* unmeasured) {
        (measure ? measured : unmeasured)(s, bonds, law, beams, rows, begin, end, dt, out);
    };
    // Rare variants take dashpots along, which cost them little.
    if (beams.any()) {
        pick(run<Law, true, true, true>, run<Law, true, true, false>);
    } else if (bonds.damped) {
        pick(run<Law, true, false, true>, run<Law, true, false, false>);
    } else {
        pick(run<Law, false, false, true>, run<Law, false, false, false>);
    }
}

template <class List> struct Kernels;
template <class... Laws> struct Kernels<TypeList<Laws...>> { static constexpr BondKernel each[] = {kernel<Laws>...}; };

} // namespace

const BondKernel* PROVETA_VARIANT(bond_kernels)() { return Kernels<BondLaws>::each; }

} // namespace proveta
