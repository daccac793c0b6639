// The tests that every trial of a sweep or a calibration carries out.
#pragma once

#include <string>
#include <vector>

#include "core/input/json.hpp"

namespace proveta {

/// A test of a trial.
struct TrialTest {
    std::string name;
    input::Json deck;                ///< resolved
    input::Json written;             ///< as the user wrote it, merged over the common part
    std::vector<std::int64_t> seeds; ///< of its specimens; empty for a stored one
    double weight = 1.0;             ///< of its targets
    std::vector<std::string> files;  ///< that it was read from
};

/// The keys of a test but its deck.
struct TestKeys {
    std::string name;
    std::vector<double> seeds{1};
    double weight = 1.0;
};
void declare(input::Visitor& v, TestKeys& keys);

/// What is asked of "tests".
struct TestRules {
    bool targets = false;              ///< there are targets, which weights are for
    bool begun = false;                ///< they are read from a manifest, whose decks have every value filled in
    input::Json decks_begun_with = {}; ///< resolved decks by the names of their tests, which count instead of what is written
};

/// Takes "deck" (what all tests share) and "tests" out of the JSON of a sweep or a calibration and reads them. A test's "deck" is an object
/// or the name of a file, relative to the file that is read. A key that `proveta run` honours and trials do not is refused. Appends what is
/// wrong to `problems`.
std::vector<TrialTest> take_tests(input::Json& json, const std::string& file, input::Problems& problems, const TestRules& rules);

/// Hashes of the files that tests were read from, by name.
input::Json hashes_of(const std::vector<TrialTest>& tests);

/// JSON schema of "deck" and "tests", to be added to that of what else is in the file.
void add_tests_to_schema(input::Json& schema);

} // namespace proveta
