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
#include "lab/rate_control.hpp"
#include "reports/record/record.hpp"
#include "specimens/specimen.hpp"

namespace proveta {

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

/// What a protocol may know of the run so far.
struct BenchView {
    const Model& model;
    const Shape& shape;
    double wave_speed;          ///< of a bar of the material, m/s
    const report::Table& curve; ///< samples so far
};

/// Parts 2 and 3: a piece of the test with its control. Times in s since the stage began.
struct Stage {
    std::string name;
    std::function<std::vector<double>(const BenchView&, double time)> speeds; ///< of each platen, m/s
    std::function<bool(const BenchView&, double time)> finished;              ///< asked at samples; the last stage ends by stop rules
    std::shared_ptr<RateControl> rate; ///< leads the speeds; it is shown the model and taken along step by step. Or null
};

class Protocol {
  public:
    virtual ~Protocol() = default;

    /// Part 1.
    [[nodiscard]] virtual ProtocolInfo about() const = 0;

    /// The "loading" section.
    virtual void declare_loading(input::Visitor& v) = 0;
    /// What loading and specimen contradict.
    virtual void check(const SpecimenRecipe& recipe, const std::string& source, const std::string& path,
                       input::Problems& problems) const = 0;

    /// Boundaries for the specimen.
    [[nodiscard]] virtual std::vector<Platen> platens(const Spheres& spheres, const Shape& shape) const = 0;
    /// Part 2.
    /// pace: factor on all speeds, for a check that they do not matter.
    [[nodiscard]] virtual std::vector<Stage> stages(const BenchView& bench, double pace) const = 0;
    /// True when the test is to be run again at half the rate.
    [[nodiscard]] virtual bool checks_rate() const { return false; }
    /// Nominal axial strain that the samples are spread over.
    [[nodiscard]] virtual double strain_range() const = 0;
    /// Part 4: why the test is over, asked at every sample.
    [[nodiscard]] virtual std::optional<std::string> stop(const BenchView& bench) const = 0;
    /// Part 5.
    [[nodiscard]] virtual std::vector<report::Scalar> results(const report::Table& curve, const report::Table& energy) const = 0;
};

inline void declare(input::Visitor& v, Protocol& protocol) { protocol.declare_loading(v); }

} // namespace proveta
