// The tables of a test's page, and its table of failed bonds.
#pragma once

#include <string>
#include <vector>

#include "lab/bench.hpp"
#include "lab/deck.hpp"
#include "lab/failure_event.hpp"
#include "reports/record/record.hpp"

namespace proveta {

/// events.csv.
report::Table event_table(const std::vector<FailureEvent>& events);

/// The last row of energy.csv, each term with its meaning.
report::TextTable ledger_table(const report::Table& energy);

/// What the specimen is made of, bonded or loose.
report::TextTable specimen_table(const Deck& deck, const Bench& bench);

/// What of the standards a test mimics, and what not.
report::TextTable standards_table(const ProtocolInfo& info);

/// Program, deck, specimen and steps: what it takes to repeat the run. seconds: wall time of the loading.
report::TextTable provenance_table(const Deck& deck, const Bench& bench, double seconds);

/// What mass scaling did, in a sentence.
std::string text_of(const MassScaling& scaling);

} // namespace proveta
