// The loop over loose contacts. Compiled once per instruction set; PROVETA_VARIANT names the variant's entry point.
//
// Most of a neighbour list does not touch. A first pass finds, by distances alone, the pairs that do, or did at the last step; a second one
// advances these, a vector of them at a time.
#include "core/contacts/contact_kernel.hpp"

#include "core/contacts/hertz_law.hpp"
#include "core/contacts/linear_law.hpp"
#include "core/contacts/pair_kinematics.hpp"
#include "core/contacts/rolling.hpp"
#include "core/parallel/variant.hpp"

namespace proveta {

namespace {

// The laws under one name, for the loop.
struct Linear {
    static constexpr ContactLaw kind = ContactLaw::linear;
    template <class T> using Parameters = linear::Parameters<T>;
    template <class... Args> PROVETA_INLINE static auto advance(Args&&... args) { return linear::advance(args...); }
};
struct Hertz {
    static constexpr ContactLaw kind = ContactLaw::hertz;
    template <class T> using Parameters = hertz::Parameters<T>;
    template <class... Args> PROVETA_INLINE static auto advance(Args&&... args) { return hertz::advance(args...); }
};

// Whether the pairs of one group are apart.
template <class T> PROVETA_INLINE auto apart(const SphereView& s, const ContactView& c, std::size_t k) {
    const NearGather<T> of_i(&c.i[k], s.count);
    T square = T(0.0);
    for (int x = 0; x < 3; ++x) {
        const T to = gather<T>(s.position[x], &c.j[k]) - of_i(s.position[x]);
        square = square + to * to;
    }
    const T reach = load<T>(&c.reach[k]);
    return square > reach * reach;
}

template <class T>
PROVETA_INLINE std::size_t list_group(const SphereView& s, const ContactView& c, std::size_t k, std::uint32_t* touching, std::size_t n) {
    const auto away = apart<T>(s, c, k);
    for (std::size_t lane = 0; lane < lane_count<T>(); ++lane) {
        const bool gone = mask_lane(away, lane);
        if (!gone || c.active[k + lane] != 0 || c.pulls) {
            touching[n++] = static_cast<std::uint32_t>(k + lane);
        }
        c.active[k + lane] = gone ? 0 : 1;
    }
    return n;
}

// One quantity of a contact's law in a group.
template <class T, class Of> PROVETA_INLINE T of_laws(const LooseContact* law, const std::uint32_t* k, const Of& of) {
    if constexpr (std::is_same_v<T, double>) {
        return of(law[*k]);
    } else {
        return T([&](auto lane) { return of(law[k[lane]]); });
    }
}

template <class T> PROVETA_INLINE void scatter(double* to, const std::uint32_t* k, const T& value) {
    for (std::size_t lane = 0; lane < lane_count<T>(); ++lane) {
        to[k[lane]] = in_lane(value, lane);
    }
}

// The contacts k[0], k[1], ... of one law, none of them or all of them able to pull.
template <class Law, class T>
PROVETA_INLINE void advance_group(const SphereView& s, const ContactView& c, double* rows, const std::uint32_t* k, const ContactStep& step,
                                  ContactEnergies& sum) {
    constexpr std::size_t width = lane_count<T>();
    std::int32_t index[width];
    std::int32_t i[width];
    std::int32_t j[width];
    std::int32_t row_j[width];
    for (std::size_t lane = 0; lane < width; ++lane) {
        index[lane] = static_cast<std::int32_t>(k[lane]);
        i[lane] = c.i[k[lane]];
        j[lane] = c.j[k[lane]];
        row_j[lane] = c.row_j[k[lane]];
    }
    const auto law = [&](auto of) { return of_laws<T>(c.law, k, of); };
    T old[3];
    T last[3]; // force of the dashpots on i at the last step
    for (int x = 0; x < 3; ++x) {
        old[x] = gather<T>(c.slip[x], index);
        last[x] = gather<T>(c.viscous[x], index);
    }
    const T share = gather<T>(c.share, index);
    const auto pair = pair_kinematics<T>(s, i, j, share, old, step.elapsed);
    // The dashpots' last force, taken apart along the pair's present frame.
    const T pulled = last[0] * pair.n[0] + last[1] * pair.n[1] + last[2] * pair.n[2];
    contact::State<T> state;
    state.viscous = -pulled;
    for (int x = 0; x < 3; ++x) {
        state.u_t[x] = pair.turned[x];
        state.viscous_t[x] = last[x] - pulled * pair.n[x];
    }
    const typename Law::template Parameters<T> parameters{law([](const LooseContact& l) { return l.k_n; }),
                                                          law([](const LooseContact& l) { return l.k_t; }),
                                                          law([](const LooseContact& l) { return l.c_n; }),
                                                          law([](const LooseContact& l) { return l.c_t; }),
                                                          law([](const LooseContact& l) { return l.friction; }),
                                                          c.law[k[0]].tension,
                                                          step.impacts,
                                                          step.impacts ? law([](const LooseContact& l) { return l.reduced_mass; })
                                                                       : T(1.0)};
    const T reach = gather<T>(c.reach, index);
    const T overlap = reach - pair.distance;
    const T approach = -pair.separation * step.elapsed;
    const auto r = Law::advance(parameters, overlap, approach, step.elapsed, pair.slip, state);
    for (int x = 0; x < 3; ++x) {
        scatter(c.slip[x], k, state.u_t[x]);
        scatter(c.viscous[x], k, T(state.viscous_t[x] - state.viscous * pair.n[x]));
    }
    scatter(c.normal, k, r.normal);

    T couple[3] = {T(0.0), T(0.0), T(0.0)};
    T rolled = T(0.0);
    if (c.rolls) {
        T spin[3];
        for (int x = 0; x < 3; ++x) {
            spin[x] = gather<T>(s.spin[x], i) - gather<T>(s.spin[x], j);
        }
        const auto rolling = rolling::torque<T>(law([](const LooseContact& l) { return l.rolling_arm; }), r.normal,
                                                law([](const LooseContact& l) { return l.reduced_inertia; }), spin, step.dt);
        for (int x = 0; x < 3; ++x) {
            couple[x] = rolling.torque[x];
        }
        rolled = rolling.power * step.elapsed;
    }
    const auto force = add_pair_loads(rows, i, row_j, pair, share, r.normal, r.shear, couple);
    for (int x = 0; x < 3; ++x) {
        scatter(c.force[x], k, force.x[x]);
    }
    if (step.overlaps) {
        using std::min;
        const T deep = overlap / (reach * min(share, T(1.0 - share))); // the share divides the radii
        for (std::size_t lane = 0; lane < width; ++lane) {
            sum.deepest = std::max(sum.deepest, in_lane(deep, lane));
        }
    }
    const T slid = r.friction_work + rolled;
    for (std::size_t lane = 0; lane < width; ++lane) {
        sum.stored += in_lane(r.stored, lane);
        sum.friction += in_lane(slid, lane);
        sum.dashpot += in_lane(r.dashpot_work, lane);
    }
}

// The contacts of one law among those listed, in their order. Contacts that may pull go one by one: few, and only in comparisons.
template <class Law>
std::size_t run(const SphereView& s, const ContactView& c, double* rows, const std::uint32_t* touching, std::size_t n,
                const ContactStep& step, ContactEnergies& sum) {
    constexpr std::size_t width = lane_count<Lanes>();
    std::uint32_t group[width];
    std::size_t filled = 0;
    std::size_t met = 0;
    for (std::size_t k = 0; k < n; ++k) {
        if (c.law[touching[k]].law != Law::kind) {
            continue;
        }
        ++met;
        if (c.pulls) {
            advance_group<Law, double>(s, c, rows, &touching[k], step, sum);
            continue;
        }
        group[filled++] = touching[k];
        if (filled == width) {
            advance_group<Law, Lanes>(s, c, rows, group, step, sum);
            filled = 0;
        }
    }
    for (std::size_t k = 0; k < filled; ++k) {
        advance_group<Law, double>(s, c, rows, &group[k], step, sum);
    }
    return met;
}

} // namespace

void PROVETA_VARIANT(contact_kernel)(const SphereView& s, const ContactView& c, double* rows, std::size_t begin, std::size_t end,
                                     const ContactStep& step, ContactEnergies& sum) {
    sum = {};
    std::uint32_t* touching = c.touching + begin;
    std::size_t n = 0;
    std::size_t k = begin;
    for (; k + lane_count<Lanes>() <= end; k += lane_count<Lanes>()) {
        n = list_group<Lanes>(s, c, k, touching, n);
    }
    for (; k < end; ++k) {
        n = list_group<double>(s, c, k, touching, n);
    }
    if (run<Hertz>(s, c, rows, touching, n, step, sum) < n) {
        run<Linear>(s, c, rows, touching, n, step, sum);
    }
}

} // namespace proveta
