// What a calibration is asked for: calibration.json.
#pragma once

#include <string>
#include <vector>

#include "lab/trials/parameters.hpp"
#include "lab/trials/tests.hpp"

namespace proveta {

/// What a test should come to: a result, or a curve from a file.
struct TargetInput {
    std::string test;
    std::string use = "fit";
    std::string kind = "measured";
    std::string source;
    double weight = 1.0;
    double tolerance = 0.05;
    // a result
    std::string result;
    double value = 0.0;
    // a curve
    std::string curve;
    std::string x = "axial_strain";
    std::string y;
    std::string x_column = "1";
    std::string y_column = "2";
    double x_factor = 1.0;
    double y_factor = 1.0;
    double x_offset = 0.0;
    std::string toe = "as_measured";
    input::NumberOrWord from{0.0, "start"};
    input::NumberOrWord to{0.0, "end"};

    [[nodiscard]] bool is_curve() const { return !curve.empty(); }
    [[nodiscard]] bool fitted() const { return use == "fit"; }
    /// "ucs strength", "ucs total_stress over axial_strain".
    [[nodiscard]] std::string title() const { return test + " " + (is_curve() ? y + " over " + x : result); }
};

/// How the card is searched for.
struct SearchInput {
    double spheres = 0.1;
    std::int64_t seeds = 1;
    std::int64_t trials = 100;
    std::int64_t batch = 4;
    std::int64_t seed = 1;
    std::string method = "mixed";
    double good_enough = 0.0;
};

/// How it is finished on whole specimens.
struct FinishInput {
    std::int64_t rounds = 3;
    std::int64_t trials = 20;
};

/// What is done to say how sure the card is.
struct ConfidenceInput {
    std::int64_t seeds = 4;
    double step = 0.1;
};

/// The card that is written.
struct CardInput {
    std::string name = "calibrated";
    std::string about;
    std::string status = "provisional";
};

/// A calibration as read.
struct CalibrationInput {
    std::string title = "Calibration";
    std::vector<Parameter> parameters;
    std::vector<TargetInput> targets;
    SearchInput search;
    FinishInput finish;
    ConfidenceInput confidence;
    CardInput card;
};

void declare(input::Visitor& v, TargetInput& t);
void declare(input::Visitor& v, SearchInput& s);
void declare(input::Visitor& v, FinishInput& f);
void declare(input::Visitor& v, ConfidenceInput& c);
void declare(input::Visitor& v, CardInput& c);
void declare(input::Visitor& v, CalibrationInput& c);

/// A calibration, checked.
struct CalibrationPlan {
    CalibrationInput input;
    std::vector<TrialTest> tests;
    ParameterSpace space;
    input::Json written; ///< the file
    std::string source;  ///< its name
    input::Json files;   ///< hashes of deck and card files, by name
    input::Json curves;  ///< hashes of files of measured curves, by name
};

/// Reads calibration.json, or the manifest.json of an earlier calibration. Throws InputError with every problem: of the file, of the decks,
/// and of the decks that the parameters make at their bounds.
CalibrationPlan read_calibration(const std::string& file);

/// manifest.json of a calibration: the input, the decks and the files that it began with. status: running, complete or interrupted.
input::Json calibration_manifest(const CalibrationPlan& plan, const std::string& command, const std::string& status);

/// JSON schema of the file.
input::Json calibration_schema();

} // namespace proveta
