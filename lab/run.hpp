// Running a test from a deck to a folder of results.
#pragma once

#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>

#include "lab/deck.hpp"
#include "lab/output_folder.hpp"
#include "lab/test_plots.hpp"

namespace proveta {

/// What to do in a folder.
enum class Passage {
    begin, ///< run from the start, replacing an earlier result
    go_on, ///< run on from the folder's last checkpoint
    report ///< write all files anew from the last checkpoint, and take no step
};

struct RunOptions {
    std::string out;     ///< result folder
    std::string command; ///< as typed, for the manifest
    bool quiet = false;
    Passage passage = Passage::begin;
};

/// How a run ended.
enum class RunStatus { complete, interrupted, failed };

/// "complete", "interrupted" or "failed".
const char* name(RunStatus status);

/// Whoever watches a test. Called from the thread that carries it out.
struct RunWatch {
    /// phase: what is going on, "loading" or "half-rate check"; figures: strain, stress and so on; done: share of the phase, 0 to 1.
    std::function<void(const std::string& phase, const std::string& figures, double done)> progress;
    std::function<void(const std::string& line)> log;
    std::function<void(const std::string& line)> warn; ///< what the user should know of the specimen in the press, where a test begins
};

/// A test that was carried out and whose folder is written.
struct Finished {
    RunStatus status = RunStatus::failed;
    report::Record record;
    MainCurve curve;
    double seconds = 0.0; ///< that the loading took, by the clock on the wall
};

/// The user stopped a test before it began: nothing was cleared or written.
struct StoppedBefore : std::runtime_error {
    StoppedBefore() : std::runtime_error("interrupted before the test began: nothing was written") {}
};

/// Tests a specimen and writes the folder, which is begun once the specimen is in the press. Several threads may do so at once, each with
/// a folder of its own; the test is worked on by as many threads as OpenMP would give to the calling one. Files of a run that goes on from
/// a checkpoint are the same to the byte as those of one that was never stopped. Throws InputError, before
/// anything is written, when deck and specimen do not fit together or the checkpoints are of another test, StoppedBefore, and FileError.
Finished carry_out(const Deck& deck, Specimen specimen, OutputFolder& out, const std::string& command, const RunWatch& watch,
                   Passage passage = Passage::begin);

/// Held while HDF5 or VTK are at work: as usually packaged they are not made for several threads at once.
std::mutex& file_libraries();

/// Makes or loads the specimen, tests it, writes the folder, prints the results on stdout. Throws InputError before anything is
/// written when the input is wrong, and FileError when the folder cannot be written any more.
RunStatus run_test(const Deck& deck, const RunOptions& options);

} // namespace proveta
