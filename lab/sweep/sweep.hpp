// A sweep: tests at many points of a space of parameters.
#pragma once

#include <string>
#include <vector>

#include "lab/sweep/design.hpp"
#include "lab/trials/parameters.hpp"
#include "lab/trials/tests.hpp"
#include "lab/trials/trial.hpp"

namespace proveta {

/// What sweep.json says beside its tests.
struct SweepInput {
    std::string title;
    std::string design = "sobol";
    std::int64_t points = 16; ///< of a grid: unused; of Morris' design: trajectories
    std::int64_t levels = 4;  ///< of Morris' design
    std::int64_t seed = 1;
    std::vector<Parameter> parameters;
};
void declare(input::Visitor& v, SweepInput& sweep);

/// A sweep as read, checked and laid out.
struct Sweep {
    SweepInput input;
    std::vector<std::string> results; ///< asked for; empty: all
    std::vector<TrialTest> tests;
    ParameterSpace space;
    std::vector<Point> points;               ///< in the unit cube
    std::vector<std::vector<double>> values; ///< own values of the parameters at the points
    input::Json files;                       ///< hashes of the files that it was read from, by name

    [[nodiscard]] bool trajectories() const { return input.design == "morris"; }
};

/// Reads sweep.json, or the manifest.json of an earlier sweep. The decks in the middle of all ranges and with each parameter at its bounds
/// (of a grid: at its levels) have to be right, so that nothing is run for a mistake. Throws InputError with every problem.
Sweep read_sweep(const std::string& file);

/// What every point asks: the jobs of all tests and seeds.
std::vector<Trial> trials_of(const Sweep& sweep);

/// The sweep with its tests' decks resolved; reading it gives the same trials.
input::Json resolved(const Sweep& sweep);

/// JSON schema of sweep.json.
input::Json sweep_schema();

} // namespace proveta
