// Results of tests side by side: what differs, and by how much.
#pragma once

#include <string>
#include <vector>

#include "reports/record/record.hpp"

namespace proveta {

/// A test whose result folder was read back.
struct StoredResult {
    std::string name; ///< of its folder, within its series where it has one
    std::string folder;
    std::string test;
    std::string status;
    std::vector<report::Scalar> results;
    std::vector<std::string> warnings; ///< its own
    report::Table curve;               ///< columns are named as in the file: "axial_stress_Pa"
    report::Table energy;              ///< the same
};

/// Reads the results of tests; a series stands for its members. Throws InputError with every folder that holds none, saying why.
std::vector<StoredResult> read_results(const std::vector<std::string>& folders);

/// A value of a results table over that of the first test, minus 1; none where one of them is missing or the first is 0.
std::optional<double> difference(const report::Scalar& first, const report::Scalar& other);

/// The table of all results: a row each, a column a test, and the difference from the first of them.
report::TextTable comparison_table(const std::vector<StoredResult>& tests);

/// The same with all digits, in SI units, for a file.
report::TextTable comparison_values(const std::vector<StoredResult>& tests);

/// Curves of several tests in one plot. x, y: columns of curve.csv, or else of energy.csv, with their unit or without. Throws InputError
/// when a test has no such column, with the nearest name.
report::Plot overlay(const std::vector<StoredResult>& tests, const std::string& x, const std::string& y);

/// A page with the overlay and the table.
report::Record comparison(const std::vector<StoredResult>& tests, const std::string& x, const std::string& y);

} // namespace proveta
