// What a sweep or a calibration varies: named parameters of its decks.
#pragma once

#include <string>
#include <vector>

#include "core/input/json.hpp"
#include "lab/trials/tests.hpp"

namespace proveta {

/// A value of the decks that is varied, or that follows another one.
struct Parameter {
    std::string name; ///< empty: the last part of the path
    std::string path; ///< in the deck, "material.tau_f", "material.lcs.0"
    double low = 0.0;
    double high = 0.0;
    std::vector<double> values; ///< the levels of a grid, instead of low and high
    std::int64_t levels = 3;    ///< of a grid between low and high
    std::string scale = "linear";
    std::string times;  ///< name of an earlier parameter that this one is a multiple of
    double power = 1.0; ///< of that parameter, in the product
    std::string unit;   ///< SI unit of what is written into the deck

    /// Its value for u, 0 to 1 from low to high, evenly or, with a logarithmic scale, in equal ratios.
    [[nodiscard]] double at(double u) const;
    /// The u of a value.
    [[nodiscard]] double position(double value) const;
};

void declare(input::Visitor& v, Parameter& p);

/// Refuses keys that are there and that nothing looks at. why: "the design is sobol".
void refuse_keys(const input::Json& json, const std::string& path, const std::vector<std::string>& keys, const std::string& why,
                 const std::string& file, input::Problems& problems);
/// Refuses the levels of a grid among the parameters of what is none.
void refuse_levels(const input::Json& json, const std::string& why, const std::string& file, input::Problems& problems);

/// Refuses bounds and values of parameters whose unit is not one of what they are written into. json: the file.
void check_units(const input::Json& json, const std::vector<Parameter>& parameters, const std::vector<TrialTest>& tests,
                 const std::string& file, input::Problems& problems);

/// The parameters of a sweep or a calibration, in their order.
class ParameterSpace {
  public:
    ParameterSpace() = default;
    /// Checks names, paths, bounds and multiples against the decks that they change; appends what is wrong to `problems`.
    ParameterSpace(std::vector<Parameter> parameters, const std::vector<input::Json>& decks, const std::string& source,
                   input::Problems& problems);

    [[nodiscard]] std::size_t size() const { return parameters_.size(); }
    [[nodiscard]] const Parameter& operator[](std::size_t k) const { return parameters_[k]; }

    /// Own values at a point of the unit cube; a parameter with `times` has its multiple here.
    [[nodiscard]] std::vector<double> values(const std::vector<double>& u) const;
    /// What is written into the decks: multiples multiplied out.
    [[nodiscard]] std::vector<double> resolved(const std::vector<double>& values) const;
    /// Writes values into a deck; a path that it lacks is left out.
    void apply(input::Json& deck, const std::vector<double>& values) const;

  private:
    std::vector<Parameter> parameters_;
    std::vector<std::size_t> parent_; // index, or its own for a parameter without `times`
};

} // namespace proveta
