// Verification results for people: the printed table, the documentation page, plots and their data.
#pragma once

#include <string>
#include <vector>

#include "lab/verification/case.hpp"

namespace proveta::verification {

/// A case that was run.
struct Finished {
    const Case* which = nullptr;
    Outcome outcome;
    std::string failure; ///< non-empty: it threw, and what
    double seconds = 0.0;

    [[nodiscard]] bool holds() const;
};

/// Runs a case; what it throws becomes its failure.
Finished run(const Case& which);

/// Columns case, quantity, expected, found, error, allowed, thesis, verdict; a line a check.
std::vector<std::vector<std::string>> rows(const Finished& finished);

/// Rows of all cases as text with aligned columns, under a heading.
std::string as_text(const std::vector<Finished>& finished);

/// Rows, notes and links to the plots (`folder`/`plot_file`) as Markdown.
std::string as_markdown(const std::vector<Finished>& finished, const std::string& folder);

/// Name of the k-th plot's file without ending: the case's name, with a number from the second on.
std::string plot_file(const Case& which, std::size_t k);

/// Writes every plot of a case as SVG and its curves as CSV into a folder.
void write_plots(const Finished& finished, const std::string& folder);

} // namespace proveta::verification
