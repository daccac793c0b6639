// A case with a known answer: what `proveta verify` computes and the verification tests require.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reports/record/record.hpp"

namespace proveta::verification {

/// How a found value is held against the expected one.
enum class Compare {
    relative, ///< |found - expected| <= tolerance |expected|
    absolute, ///< |found - expected| <= tolerance, in the quantity's unit
    at_most,  ///< found <= expected
    at_least, ///< found >= expected
    reported  ///< no answer is known: shown, never judged
};

/// One quantity of a case. `expected` is known independently of the program: a closed form, a literal of the literature, a conserved
/// quantity.
struct Check {
    std::string quantity;
    double expected = 0.0;
    double found = 0.0;
    double tolerance = 0.0;
    Compare how = Compare::relative;
    std::string unit{};
    std::string thesis{}; ///< the thesis's own answer or error where it reports one, as text

    [[nodiscard]] bool holds() const;   ///< false for anything that is not a number
    [[nodiscard]] double error() const; ///< relative to the expected value, or absolute where that is the rule (or expected is 0)
};

/// What a case brought. Plots carry the data of the figures that the case redraws.
struct Outcome {
    std::vector<Check> checks;
    std::vector<report::Plot> plots;
    std::vector<std::string> notes; ///< what a reader must know to judge the figures
};

/// A case. Cases with `is_long` take more than a few tens of seconds and run only when named or with --all.
struct Case {
    std::string name;
    std::string section; ///< of the thesis
    std::string about;   ///< one sentence
    bool is_long = false;
    std::function<Outcome()> run;
};

/// Every case, in the order of the thesis.
const std::vector<Case>& cases();

} // namespace proveta::verification
