// From the data of a test to what is reported.
#pragma once

#include <string>

#include "core/input/json.hpp"
#include "lab/acoustic.hpp"
#include "lab/test_run.hpp"
#include "reports/record/record.hpp"

namespace proveta {

/// events.csv.
report::Table event_table(const std::vector<FailureEvent>& events);

/// What belongs to one acoustic event of a specimen.
AcousticRule acoustic_rule(const Bench& bench);

/// Everything that the page shows. acoustic: the events among data.events.
report::Record make_record(const Deck& deck, const Bench& bench, const TestData& data, const std::vector<AcousticEvent>& acoustic,
                           const std::string& status);

/// summary.json.
input::Json summary(const report::Record& record, const Bench& bench, const TestData& data, double seconds);

/// What mass scaling did, in a sentence.
std::string text_of(const MassScaling& scaling);

/// Results and verdicts for a terminal.
std::string as_text(const report::Record& record);

} // namespace proveta
