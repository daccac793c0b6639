// From the data of a test to what is reported.
#pragma once

#include <string>

#include "core/input/json.hpp"
#include "lab/acoustic.hpp"
#include "lab/series/mean_curve.hpp"
#include "lab/test_run.hpp"
#include "reports/record/record.hpp"

namespace proveta {

/// events.csv.
report::Table event_table(const std::vector<FailureEvent>& events);

/// What belongs to one acoustic event of a specimen.
AcousticRule acoustic_rule(const Bench& bench);

/// The curve that stands for a test: the first of its first plot, in SI units and in the sense that the test draws it.
struct MainCurve {
    SampledCurve values;
    report::Column x, y; ///< the columns of the curve or the energies that it is made of
    PlotAxes axes;       ///< how it is drawn
};

/// Throws std::out_of_range when the protocol draws columns that there are not.
MainCurve main_curve(const Protocol& protocol, const TestData& data);

/// Everything that the page shows. acoustic: the events among data.events.
report::Record make_record(const Deck& deck, const Bench& bench, const TestData& data, const std::vector<AcousticEvent>& acoustic,
                           const std::string& status);

/// The badges as they stand in summary.json.
input::Json verdicts_of(const std::vector<report::Badge>& badges);

/// summary.json: what the test found and nothing of how long it took, so that two runs of one deck have the same to the byte.
input::Json summary(const report::Record& record, const Bench& bench, const TestData& data);

/// What mass scaling did, in a sentence.
std::string text_of(const MassScaling& scaling);

/// Results and verdicts for a terminal.
std::string as_text(const report::Record& record);

} // namespace proveta
