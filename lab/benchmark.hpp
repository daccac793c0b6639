// How fast this machine steps a specimen: time per bond and step, its phases, its memory traffic against a triad beside it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lab/bench.hpp"

namespace proveta::benchmark {

/// What to measure.
struct Plan {
    std::vector<int> threads{1, 2};
    int repeats = 5;                     ///< of every measurement, the thread counts in turn
    double seconds = 0.4;                ///< about how long one of them lasts
    std::size_t past_peak_up_to = 20000; ///< largest specimen, in spheres, that is also broken and measured past its peak
};

/// Medians over the repeats. "Active" pairs are bonds that have not failed, failed ones that are pressed, and contacts that touch.
struct Figures {
    std::string state; ///< "elastic" or "past_peak"
    int threads = 1;
    std::size_t spheres = 0;
    std::size_t bonds = 0;
    std::size_t failed = 0;
    std::size_t active = 0;
    double ns_per_bond_step = 0.0; ///< whole step over active pairs
    double ns_forces = 0.0;        ///< the part of it in forces: bonds, contacts, boundaries
    double ns_motion = 0.0;        ///< in motion
    double share_forces = 0.0;     ///< of the step
    double share_motion = 0.0;
    double particle_steps = 0.0;        ///< spheres times steps over seconds
    double bytes_per_bond = 0.0;        ///< that a step reads and writes, over active pairs
    double bandwidth = 0.0;             ///< those bytes over the time, B/s
    double triad = 0.0;                 ///< of a triad over as much memory with as many threads, in the same run, B/s
    double triad_ratio = 0.0;           ///< time of the step over the time that the triad takes for the step's bytes
    double peak = 0.0;                  ///< lane operations a second that as many threads do in registers, in the same run
    double peak_ratio = 0.0;            ///< time of the forces over the time that these operations take at that rate
    double lowest = 0.0, highest = 0.0; ///< ns_per_bond_step over the repeats
};

/// Bytes that a step of the model must read and write at least, every array counted once a phase.
double bytes_per_step(const Model& model);

/// Vector operations of the kernel's elastic path for one vector of bonds, that is lane operations a bond: additions, multiplications,
/// comparisons, conversions and shuffles in the disassembly of the AVX-512 loop, without loads and stores, a gather counted as one.
constexpr double operations_per_bond = 220.0;

/// Lane operations (additions, multiplications) a second of `threads` threads in registers, best of `repeats`.
double arithmetic_peak(int threads, int repeats);

/// Bandwidth of a = b + s c over arrays of `bytes` in all, B/s: 24 bytes an element, median of `repeats`.
double triad_bandwidth(double bytes, int threads, int repeats);

/// Measures one specimen. line: called with every finished measurement.
std::vector<Figures> measure(Bench& bench, const Plan& plan, const std::function<void(const Figures&)>& line);

/// "threads T spheres N ... ns_per_bond_step X ...".
std::string as_line(const Figures& figures);
input::Json as_json(const Figures& figures);

} // namespace proveta::benchmark
