// The loop over spheres. Compiled once per instruction set; PROVETA_VARIANT names the variant's entry point.
#include "core/motion/motion_kernel.hpp"

#include <cmath>

#include "core/geometry/rows.hpp"
#include "core/parallel/variant.hpp"

namespace proveta {

namespace {

// Sums over spheres in eight strands, sphere k in strand k mod 8, so that they do not depend on the width of the vectors.
struct Strands {
    double sum[row_length] = {};

    template <class T> PROVETA_INLINE void add(std::size_t k, const T& value) {
        double* at = &sum[k % row_length];
        store(at, load<T>(at) + value);
    }
    [[nodiscard]] double total() const { return ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7])); }
};

// One vector quantity (translation or rotation) through one step; returns the work of the damping.
template <bool viscous, class T> PROVETA_INLINE T kick(T (&velocity)[3], const T (&load)[3], const T& inertia, double alpha, double dt) {
    using std::sqrt;
    const T per_mass = dt / inertia;
    T work = T(0.0);
    if constexpr (viscous) {
        const double half = 0.5 * alpha * dt;
        for (int c = 0; c < 3; ++c) {
            const T after = (velocity[c] * (1.0 - half) + load[c] * per_mass) * (1.0 / (1.0 + half));
            const T sum = velocity[c] + after;
            work = work + 0.25 * dt * alpha * inertia * sum * sum;
            velocity[c] = after;
        }
    } else {
        const T speed2 = dot(velocity, velocity);
        // F_damp = -alpha |F| v / |v|
        const T factor = select(speed2 > T(0.0), alpha * sqrt(dot(load, load) / select(speed2 > T(0.0), speed2, T(1.0))), T(0.0));
        for (int c = 0; c < 3; ++c) {
            const T damping = velocity[c] * -factor;
            const T after = velocity[c] + (load[c] + damping) * per_mass;
            work = work - 0.5 * dt * damping * (velocity[c] + after);
            velocity[c] = after;
        }
    }
    return work;
}

// Which velocity carries the positions over a step: the new one, the old one, or the mean of both.
enum class Carrier { after, before, mean };

struct Totals {
    Strands work, kinetic, unbalanced;
    Strands fastest; // largest squared speed of each strand
};

// Energy at the time of the forces, of one vector quantity.
template <class T> PROVETA_INLINE T kinetic_energy(const T (&before)[3], const T (&after)[3], const T& inertia, double newer) {
    T sum = T(0.0);
    for (int c = 0; c < 3; ++c) {
        const T now = before[c] + newer * (after[c] - before[c]);
        sum = sum + now * now;
    }
    return 0.5 * inertia * sum;
}

template <class T> PROVETA_INLINE void keep_largest(Strands& s, std::size_t k, const T& value) {
    using std::max;
    double* at = &s.sum[k % row_length];
    store(at, max(load<T>(at), value));
}

template <Carrier carrier, bool viscous, class T>
PROVETA_INLINE void move_group(const MotionView& s, const MotionStep& step, std::size_t k, std::size_t begin, Totals& out) {
    using std::sqrt;
    const T mass = load<T>(&s.mass[k]);
    const T inertia = load<T>(&s.inertia[k]);
    T sums[6];
    load_rows(s.rows + row_length * k, sums);
    T force[3];
    T torque[3];
    T v[3];
    T w[3];
    T v_before[3];
    T w_before[3];
    for (int c = 0; c < 3; ++c) {
        force[c] = sums[c] + mass * step.gravity[c];
        torque[c] = sums[3 + c];
        v[c] = v_before[c] = load<T>(&s.velocity[c][k]);
        w[c] = w_before[c] = load<T>(&s.spin[c][k]);
    }
    const T lost = kick<viscous>(v, force, mass, step.damping.translation, step.kick_dt);
    out.work.add(k - begin, lost + kick<viscous>(w, torque, inertia, step.damping.rotation, step.kick_dt));
    keep_largest(out.fastest, k - begin, dot(v, v));
    if constexpr (carrier != Carrier::after) {
        keep_largest(out.fastest, k - begin, dot(v_before, v_before));
    }
    if (step.measure) {
        out.kinetic.add(k - begin, kinetic_energy(v_before, v, mass, step.newer) + kinetic_energy(w_before, w, inertia, step.newer));
        out.unbalanced.add(k - begin, T(sqrt(dot(force, force))));
    }
    for (int c = 0; c < 3; ++c) {
        const T carried = carrier == Carrier::after ? v[c] : carrier == Carrier::before ? v_before[c] : T(0.5 * (v_before[c] + v[c]));
        store(&s.velocity[c][k], v[c]);
        store(&s.spin[c][k], w[c]);
        store(&s.position[c][k], load<T>(&s.position[c][k]) + carried * step.dt);
    }
    for (std::size_t l = 0; l < row_length * lane_count<T>(); ++l) {
        s.rows[row_length * k + l] = 0.0;
    }
}

template <Carrier carrier, bool viscous>
void move(const MotionView& s, const MotionStep& step, std::size_t begin, std::size_t end, MotionSums& out) {
    Totals totals;
    std::size_t k = begin;
    for (; k + lane_count<Lanes>() <= end; k += lane_count<Lanes>()) {
        move_group<carrier, viscous, Lanes>(s, step, k, begin, totals);
    }
    for (; k < end; ++k) {
        move_group<carrier, viscous, double>(s, step, k, begin, totals);
    }
    out.damping_work = totals.work.total();
    out.kinetic = totals.kinetic.total();
    out.unbalanced = totals.unbalanced.total();
    out.fastest = 0.0;
    for (const double speed2 : totals.fastest.sum) {
        out.fastest = speed2 > out.fastest || std::isnan(speed2) ? speed2 : out.fastest;
    }
}

template <Carrier carrier> void move(const MotionView& s, const MotionStep& step, std::size_t begin, std::size_t end, MotionSums& out) {
    (step.damping.viscous ? move<carrier, true> : move<carrier, false>)(s, step, begin, end, out);
}

} // namespace

void PROVETA_VARIANT(motion_kernel)(const MotionView& s, const MotionStep& step, Scheme scheme, std::size_t begin, std::size_t end,
                                    MotionSums& out) {
    switch (scheme) {
    case Scheme::forward_euler: move<Carrier::before>(s, step, begin, end, out); break;
    case Scheme::taylor: move<Carrier::mean>(s, step, begin, end, out); break;
    default: move<Carrier::after>(s, step, begin, end, out);
    }
}

} // namespace proveta
