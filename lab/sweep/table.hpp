// What a sweep came to: a row a point, and how each result depends on each parameter.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "lab/sweep/sensitivity.hpp"
#include "lab/sweep/sweep.hpp"
#include "lab/trials/book.hpp"
#include "reports/record/record.hpp"

namespace proveta {

/// A result of a test at all points; not a number where it failed or could not be determined.
struct ResultColumn {
    std::string test, result, unit;
    std::vector<double> mean;      ///< over the seeds
    std::vector<double> deviation; ///< standard deviation over the seeds - 1; empty for a test with one specimen

    [[nodiscard]] std::string name() const { return test + "." + result; }
};

/// Rows are points, in the order of the design.
struct SweepTable {
    std::vector<TrialResult> trials;   ///< with the parameters as the decks have them
    std::vector<ResultColumn> results; ///< of the tests in their order, those of a test by name

    [[nodiscard]] bool complete(std::size_t point) const;
    [[nodiscard]] bool quasi_static(std::size_t point) const; ///< all jobs that gave results
    [[nodiscard]] std::size_t failed() const;
};
SweepTable make_table(const Sweep& sweep, std::vector<TrialResult> trials);

/// table.csv, failures.csv, and table.h5: the numbers of table.csv, a dataset each column.
report::TextTable rows_of(const Sweep& sweep, const SweepTable& table);
report::TextTable failures_of(const SweepTable& table);
void write_hdf5(const Sweep& sweep, const SweepTable& table, const std::string& file);

/// Names among sweep.results that no test has given, with what may have been meant.
std::vector<std::string> unknown_results(const Sweep& sweep, const SweepTable& table);

/// How a result depends on a parameter.
struct Sensitivity {
    std::size_t n = 0;  ///< points that count; of Morris' design, elementary effects
    double value = 0.0; ///< rank correlation, or Morris' mu* over the largest of the result's; not a number for none
    double bound = 0.0; ///< what a chance rank correlation stays below, nineteen times in twenty
    Effects effects;    ///< of Morris' design
};
/// Whether it says anything: always of Morris' design, which has no bound.
inline bool beyond_chance(const Sensitivity& s) { return std::isfinite(s.value) && std::fabs(s.value) > s.bound; }
/// For each result, for each parameter.
std::vector<std::vector<Sensitivity>> sensitivities(const Sweep& sweep, const SweepTable& table);

/// sensitivity.csv.
report::TextTable sensitivity_rows(const Sweep& sweep, const SweepTable& table, const std::vector<std::vector<Sensitivity>>& found);

/// A number with all its digits; empty for none.
std::string full(double value);

} // namespace proveta
