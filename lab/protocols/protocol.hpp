// A laboratory test. One file a test, in five parts: the standard, the stages, the controls, the measurements and stop rules, the derived
// results. A new test is a class like ucs.cpp's and one line in registry.cpp.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/input/json.hpp"
#include "core/model.hpp"
#include "lab/controls/control.hpp"
#include "lab/failure_event.hpp"
#include "lab/press.hpp"
#include "materials/card.hpp"
#include "reports/record/record.hpp"
#include "specimens/specimen.hpp"

namespace proveta {

struct Deck;
class Instruments;

/// What a standard asks and what of it the test does.
struct Standard {
    std::string name;
    std::string mimics;
    std::string cannot;
};

/// Part 1: what the test is.
struct ProtocolInfo {
    std::string name; ///< as in the deck
    std::string title;
    std::string about; ///< a paragraph for `describe`
    std::vector<Standard> standards;
};

/// How far the loading has come, looked at every so many steps, whatever the samples: what ends a test must not depend on its output.
struct LoadingTrack {
    double strain = 0.0;   ///< since the loading began, in the sense of the test
    double deviator = 0.0; ///< in the sense of the test, smoothed, Pa
    double peak = 0.0;     ///< largest deviator so far
    double look_at_peak = 0.0;
    double begun = 0.0; ///< strain at which the loading began
    double looks = 0.0; ///< number of looks so far
};

/// What a protocol may know of the run so far.
struct BenchView {
    const Model& model;
    const Shape& shape;
    const Press& press;
    const Instruments& instruments;
    double wave_speed; ///< of a bar of the material, m/s; of a loose specimen an estimate at the test's pressure
    const LoadingTrack& track;
    double grain = 0.0; ///< as in `InPress`, m

    [[nodiscard]] double strain() const;       ///< in the sense of the test: closing, or parting, of the platens over their distance
    [[nodiscard]] double stress() const;       ///< in the sense of the test: mean of both platens' force over the area, Pa
    [[nodiscard]] double girth_strain() const; ///< circumferential, positive when the specimen gets thinner
    [[nodiscard]] double crossing() const { return press.length / wave_speed; } ///< time in which a wave crosses, s
};

/// Parts 2 and 3: a piece of the test with its control.
struct Stage {
    enum class Kind {
        preparing, ///< before the loading proper: stresses that the test starts from
        loading,   ///< the test itself: stop rules hold, results are taken from it
        cycling    ///< off the envelope, unloading or reloading
    };

    std::string name;
    Kind kind = Kind::loading;
    double share = 1.0; ///< of the test's samples, all stages' adding up to about 1
    std::shared_ptr<Control> control;
    std::function<double(const BenchView&)> done; ///< share of the stage that is done; at 1 it is over
    /// What `done` remembers, named like a control's state; empty when it remembers nothing.
    std::function<void(const std::string& prefix, StateVisitor& visit)> memory = nullptr;
};

/// What a test has measured.
struct Measured {
    const report::Table& curve;
    const report::Table& energy;
    const std::vector<FailureEvent>& events;
    const Shape& shape;
    const Press& press;
    double grain = 0.0;   ///< as in `InPress`, m
    double density = 0.0; ///< of the spheres or stones, kg/m3
    double overlap = 0.0; ///< as `Model::largest_overlap`
};

/// One curve of a plot: columns of the curve, or of the energies, and how they are shown.
struct PlotCurve {
    std::string x, y;
    std::string name;
    std::string colour;
    bool to_peak = false; ///< gauges no longer tell the material's strain once cracks run through them
};

/// A plot of the report.
struct PlotSpec {
    std::string title;
    std::string x_title, y_title;
    double x_scale = 1.0, y_scale = 1.0; ///< from SI to the titles' units, and sign
    std::vector<PlotCurve> curves;
    bool mark_peak = false; ///< of the first curve
};

/// What a machine is built around.
struct InPress {
    const Spheres& spheres;
    const Bonds& bonds;
    const Shape& shape;
    const std::vector<Material>& materials;
    double grain = 0.0;      ///< mean diameter of a sphere, or of the sphere of a stone's volume, m
    double wave_speed = 0.0; ///< of a bar of the material, m/s
};

class Protocol {
  public:
    virtual ~Protocol() = default;

    /// Part 1.
    [[nodiscard]] virtual ProtocolInfo about() const = 0;

    /// The specimen that the standard asks for, where a deck says nothing else.
    virtual void suggest(SpecimenRecipe&) const {}
    /// The material that is taken where a deck names none.
    [[nodiscard]] virtual std::string card() const { return MaterialInput{}.card; }
    /// Whether its specimens are loose: without bonds, and without what belongs to these in a deck.
    [[nodiscard]] virtual bool granular() const { return false; }
    /// For loose specimens: the pressure that they are tested at, on which their stiffness depends, Pa.
    [[nodiscard]] virtual double pressure() const { return 0.0; }
    /// For loose specimens: gravity during the test, m/s2, downwards.
    [[nodiscard]] virtual double gravity() const { return 0.0; }
    /// The "loading" section.
    virtual void declare_loading(input::Visitor& v) = 0;
    /// What the deck's parts contradict.
    virtual void check(const Deck& deck, input::Problems& problems) const = 0;

    /// The machine around the specimen. Throws std::invalid_argument, saying what, for a specimen that does not fit into it.
    [[nodiscard]] virtual Press press(const InPress& body) const = 0;
    /// Parts 2 and 3. pace: factor on all speeds, for a check that they do not matter.
    [[nodiscard]] virtual std::vector<Stage> stages(const BenchView& bench, double pace) const = 0;
    /// True when the test is to be run again at half the rate.
    [[nodiscard]] virtual bool checks_rate() const { return false; }
    /// Part 4: why the test is over, asked at every sample of a loading stage.
    [[nodiscard]] virtual std::optional<std::string> stop(const BenchView& bench) const = 0;
    /// Part 5.
    [[nodiscard]] virtual std::vector<report::Scalar> results(const Measured& measured) const = 0;
    /// What of the data says that a result is not what its name says, each a sentence.
    [[nodiscard]] virtual std::vector<std::string> doubts(const Measured&) const { return {}; }
    /// What the report draws, before failed bonds and energies.
    [[nodiscard]] virtual std::vector<PlotSpec> plots() const = 0;
};

inline void declare(input::Visitor& v, Protocol& protocol) { protocol.declare_loading(v); }

} // namespace proveta
