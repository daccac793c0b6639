// What a specimen looks like at a moment, kept until pictures are drawn of it.
#pragma once

#include <string>
#include <vector>

#include "lab/bench.hpp"
#include "reports/render/render.hpp"

namespace proveta {

/// Places and cracks of a specimen at a moment.
struct Snapshot {
    std::string name;  ///< of files: "intact", "peak", "past_peak", "end"
    std::string title; ///< "At the peak, strain 0.19 %"
    VectorField position;
    std::vector<std::uint8_t> mode; ///< of each bond, as `Bonds::mode`
};

Snapshot snapshot(const Model& model, const std::string& name, const std::string& title);

/// Names its values, each after `prefix`.
void visit_snapshot(const std::string& prefix, Snapshot& snapshot, StateVisitor& visit);

/// A drawing of a specimen and what its file is called: "peak_displacement.png".
struct NamedPortrait {
    std::string file;
    report::Portrait portrait;
};

/// The views of a test: displacement from outside, damage in a cut along the load, the cracks about that cut as coloured discs. The colours
/// of a quantity mean the same at all moments. height: of a picture in pixels.
std::vector<NamedPortrait> portraits(const Bench& bench, const std::vector<Snapshot>& moments, int height);

/// A still of a specimen for an animation: the cut along the load, coloured by damage.
std::string still(const Bench& bench, const Snapshot& moment, int height);

} // namespace proveta
