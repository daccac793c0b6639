// From the data of a test to what is reported.
#pragma once

#include <string>
#include <vector>

#include "lab/acoustic.hpp"
#include "lab/test_run.hpp"
#include "reports/record/record.hpp"

namespace proveta {

/// What belongs to one acoustic event of a specimen.
AcousticRule acoustic_rule(const Bench& bench);

/// Everything that the page shows. acoustic: the events among data.events.
report::Record make_record(const Deck& deck, const Bench& bench, const TestData& data, const std::vector<AcousticEvent>& acoustic,
                           const std::string& status);

/// What results a deck's test may have, with their units and without values.
std::vector<report::Scalar> possible_results(const Deck& deck);

} // namespace proveta
