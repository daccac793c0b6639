#include "lab/benchmark.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/parallel/instruction_set.hpp"
#include "core/parallel/peak_kernel.hpp"
#include "lab/clock.hpp"

namespace proveta::benchmark {

namespace {

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

// Closing speeds at which a specimen of this height would take a second to 0.1 % strain: elastic for as long as a measurement lasts.
std::vector<double> slowly(const Bench& bench) {
    const double v = 0.5e-3 * bench.specimen.shape.height;
    return {v, -v};
}

std::size_t active_pairs(const Model& model) {
    std::size_t count = 0;
    const Bonds& b = model.bonds;
    for (std::size_t k = 0; k < b.size(); ++k) {
        count += b.mode[k] == 0 || (!b.normal.empty() && b.normal[k] > 0.0) ? 1 : 0;
    }
    return count + static_cast<std::size_t>(std::count(model.contacts.active.begin(), model.contacts.active.end(), std::uint8_t{1}));
}

struct Sample {
    double step, forces, motion; // s a step
};

Sample sample(Model& model, const std::vector<double>& speeds, int steps) {
    const PhaseTimes before = model.phase_times();
    const auto start = Clock::now();
    for (int k = 0; k < steps; ++k) {
        model.step(speeds, false);
    }
    const double wall = since(start);
    const PhaseTimes& after = model.phase_times();
    return {wall / steps, (after.forces - before.forces) / steps, (after.motion - before.motion) / steps};
}

// Breaks the specimen, until the stress has fallen to four fifths of its peak.
void break_it(Bench& bench) {
    Model& model = *bench.model;
    const double v = 0.15 * bench.specimen.shape.height; // a strain rate of 0.3/s: brisk, but one main fracture and little debris
    double peak = 0.0;
    const double allowed = 0.02 * bench.specimen.shape.height; // the specimen would be rubble
    for (double travel = 0.0; travel < allowed; travel += 2.0 * v * model.dt()) {
        model.step({v, -v}, false);
        const double force = std::fabs(model.walls.platens[0].reaction.z() - model.walls.platens[1].reaction.z());
        peak = std::max(peak, force);
        if (model.broken() > model.bonds.size() / 100 && force < 0.8 * peak) {
            return;
        }
    }
}

} // namespace

double bytes_per_step(const Model& model) {
    const Bonds& b = model.bonds;
    const double bonds = static_cast<double>(b.size());
    const double spheres = static_cast<double>(model.spheres.size());
    const double kept = static_cast<double>(model.loads.kept());
    const double worn = static_cast<double>(std::count(b.worn.begin(), b.worn.end(), std::uint8_t{1}));
    const double row = sizeof(Load);
    const double d = sizeof(double);
    // Forces: three indices, four constants, the wear, the slip read and written, the history of worn bonds.
    const double per_bond = 3 * sizeof(std::int32_t) + 4 * d + 1 + 6 * d + (b.damped ? d : 0.0);
    const double in_bonds = bonds * per_bond + worn * 3 * d;
    const double in_contacts = static_cast<double>(model.contacts.size()) * (2 * sizeof(std::int32_t) + d + 1);
    const double state = 9 * d; // position, velocity, spin
    const double in_forces = spheres * (state + 2 * row) + kept * 2 * row;
    const double in_motion = spheres * (2 * state + 2 * d + 2 * row + sizeof(std::uint32_t)) + kept * (row + sizeof(std::uint32_t));
    return in_bonds + in_contacts + in_forces + in_motion;
}

double triad_bandwidth(double bytes, int threads, int repeats) {
    const auto n = std::max<std::size_t>(1024, static_cast<std::size_t>(bytes / 24.0));
    std::vector<double> a(n, 0.0);
    std::vector<double> b(n, 1.0);
    std::vector<double> c(n, 2.0);
    Team team(threads);
    const std::size_t parts = static_cast<std::size_t>(threads) * 4;
    const auto pass = [&](double s) {
        team.run(parts, [&](std::size_t p) {
            for (std::size_t k = n * p / parts; k < n * (p + 1) / parts; ++k) {
                a[k] = b[k] + s * c[k];
            }
        });
    };
    const int passes = std::max(2, static_cast<int>(4.0e8 / (24.0 * static_cast<double>(n))));
    std::vector<double> rates;
    pass(0.5);
    for (int r = 0; r < repeats; ++r) {
        const auto start = Clock::now();
        for (int k = 0; k < passes; ++k) {
            pass(1.0 + k);
        }
        const double wall = since(start);
        rates.push_back(24.0 * static_cast<double>(n) * passes / wall);
    }
    return median(rates);
}

double arithmetic_peak(int threads, int repeats) {
    static const PeakKernel kernel = PROVETA_PICK(peak_kernel);
    constexpr std::size_t rounds = 2'000'000;
    Team team(threads);
    std::vector<double> sink(static_cast<std::size_t>(threads) * 8); // a cache line each
    double best = 0.0;
    for (int r = 0; r < repeats; ++r) {
        std::atomic<std::size_t> lanes{0};
        const auto start = Clock::now();
        team.run(static_cast<std::size_t>(threads), [&](std::size_t t) { lanes = kernel(rounds, &sink[8 * t]); });
        const double wall = since(start);
        best = std::max(best, static_cast<double>(lanes * rounds * peak_operations) * threads / wall);
    }
    return best;
}

std::vector<Figures> measure(Bench& bench, const Plan& plan, const std::function<void(const Figures&)>& line) {
    Model& model = *bench.model;
    std::vector<Figures> out;
    std::vector<std::string> states{"elastic"};
    if (model.spheres.size() <= plan.past_peak_up_to) {
        states.emplace_back("past_peak");
    }
    const auto speeds = slowly(bench);
    for (const auto& state : states) {
        if (state == "past_peak") {
            break_it(bench);
        }
        model.step(speeds, true); // for the forces of failed bonds
        const double active = static_cast<double>(std::max<std::size_t>(1, active_pairs(model)));
        const double bytes = bytes_per_step(model);
        const Sample first = sample(model, speeds, 3);
        const int steps = std::clamp(static_cast<int>(plan.seconds / first.step), 3, 20000);
        std::vector<std::vector<Sample>> samples(plan.threads.size());
        std::vector<std::vector<double>> triads(plan.threads.size());
        std::vector<std::vector<double>> peaks(plan.threads.size());
        for (int r = 0; r < plan.repeats; ++r) {
            for (std::size_t t = 0; t < plan.threads.size(); ++t) {
                model.set_threads(plan.threads[t]);
                sample(model, speeds, std::max(1, steps / 20)); // wakes the team and fills its caches
                samples[t].push_back(sample(model, speeds, steps));
                triads[t].push_back(triad_bandwidth(bytes, plan.threads[t], 1));
                peaks[t].push_back(arithmetic_peak(plan.threads[t], 1));
            }
        }
        for (std::size_t t = 0; t < plan.threads.size(); ++t) {
            std::vector<double> step;
            std::vector<double> forces;
            std::vector<double> motion;
            for (const auto& s : samples[t]) {
                step.push_back(1e9 * s.step / active);
                forces.push_back(1e9 * s.forces / active);
                motion.push_back(1e9 * s.motion / active);
            }
            Figures f;
            f.state = state;
            f.threads = plan.threads[t];
            f.spheres = model.spheres.size();
            f.bonds = model.bonds.size();
            f.failed = model.broken();
            f.active = static_cast<std::size_t>(active);
            f.ns_per_bond_step = median(step);
            f.lowest = *std::min_element(step.begin(), step.end());
            f.highest = *std::max_element(step.begin(), step.end());
            f.ns_forces = median(forces);
            f.ns_motion = median(motion);
            f.share_forces = f.ns_forces / f.ns_per_bond_step;
            f.share_motion = f.ns_motion / f.ns_per_bond_step;
            const double seconds = 1e-9 * f.ns_per_bond_step * active;
            f.particle_steps = static_cast<double>(f.spheres) / seconds;
            f.bytes_per_bond = bytes / active;
            f.bandwidth = bytes / seconds;
            f.triad = median(triads[t]);
            f.triad_ratio = f.triad / f.bandwidth;
            f.peak = median(peaks[t]);
            f.peak_ratio = 1e-9 * f.ns_forces * active * f.peak / (operations_per_bond * static_cast<double>(f.bonds));
            line(f);
            out.push_back(f);
        }
    }
    return out;
}

std::string as_line(const Figures& f) {
    return fmt::format(
        "threads {} spheres {} bonds {} failed {} active {} state {} ns_per_bond_step {:.2f} lowest {:.2f} highest {:.2f} "
        "forces {:.0f}% motion {:.0f}% particle_steps_per_s {:.3g} bytes_per_bond {:.0f} GB_per_s {:.2f} triad_GB_per_s {:.2f} "
        "over_triad {:.2f} peak_Gop_per_s {:.2f} forces_over_peak {:.2f}",
        f.threads, f.spheres, f.bonds, f.failed, f.active, f.state, f.ns_per_bond_step, f.lowest, f.highest, 100.0 * f.share_forces,
        100.0 * f.share_motion, f.particle_steps, f.bytes_per_bond, 1e-9 * f.bandwidth, 1e-9 * f.triad, f.triad_ratio, 1e-9 * f.peak,
        f.peak_ratio);
}

input::Json as_json(const Figures& f) {
    return {{"state", f.state},
            {"threads", f.threads},
            {"spheres", f.spheres},
            {"bonds", f.bonds},
            {"failed_bonds", f.failed},
            {"active_pairs", f.active},
            {"ns_per_bond_step", f.ns_per_bond_step},
            {"ns_per_bond_step_lowest", f.lowest},
            {"ns_per_bond_step_highest", f.highest},
            {"ns_forces", f.ns_forces},
            {"ns_motion", f.ns_motion},
            {"share_forces", f.share_forces},
            {"share_motion", f.share_motion},
            {"particle_steps_per_s", f.particle_steps},
            {"bytes_per_bond", f.bytes_per_bond},
            {"bytes_per_s", f.bandwidth},
            {"triad_bytes_per_s", f.triad},
            {"time_over_triad", f.triad_ratio},
            {"peak_operations_per_s", f.peak},
            {"forces_over_peak", f.peak_ratio}};
}

} // namespace proveta::benchmark
