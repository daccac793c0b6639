// The decks that parameters make of the tests of a sweep or a calibration.
#pragma once

#include "lab/trials/parameters.hpp"
#include "lab/trials/tests.hpp"
#include "lab/trials/trial.hpp"

namespace proveta {

/// The deck of one specimen of a test: `seed` and `share` of its spheres, at least 50; whole where it is loose, as it is where it is
/// stored.
input::Json deck_for(const TrialTest& test, std::int64_t seed, double share);

/// The test on that specimen with the parameters at `values`. Its name is the test's, with the seed unless the specimen is stored.
Job job_for(const TrialTest& test, std::int64_t seed, double share, const ParameterSpace& space, const std::vector<double>& values);

/// Reads the decks with all parameters in the middle of their ranges, and then with each at `levels[k]` by itself. Appends to `problems`
/// what is wrong with them, at the parameter that makes it wrong, once.
void check_decks(const ParameterSpace& space, const std::vector<TrialTest>& tests, const std::vector<std::vector<double>>& levels,
                 const std::string& file, input::Problems& problems);

/// Puts the stored specimens of tests into their presses, with all parameters in the middle of their ranges, and looks whether there is
/// memory for those to be made. Says, on stderr, what the user should know before anything runs. Throws InputError with every problem.
void look_at_specimens(const ParameterSpace& space, const std::vector<TrialTest>& tests, const std::string& file);

} // namespace proveta
