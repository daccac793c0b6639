// How sure a calibrated card is.
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <string>
#include <vector>

namespace proveta {

/// A parameter's profile: the score with this one moved and the others at the best.
struct Profile {
    std::vector<double> u;     ///< positions, rising
    std::vector<double> score; ///< there; not a number where the trial failed
};

struct Confidence {
    std::vector<double> noise;          ///< standard deviation of each deviation over specimens, in tolerances, weights included
    double noise_of_score = 0.0;        ///< root of the sum of their squares: the score that two specimens of one card differ by
    std::vector<Profile> profiles;      ///< one a parameter
    Eigen::MatrixXd jacobian;           ///< deviations x parameters (unit cube)
    Eigen::MatrixXd correlation;        ///< of the parameters' errors
    std::vector<double> standard_error; ///< of the parameters, in the unit cube; infinite where the targets say nothing
};

/// Linear error analysis about the best: with deviations d = d0 + J u and their noise N, the least-squares estimate scatters by
/// (J^T J)^-1 J^T N J (J^T J)^-1; N: their covariance over specimens, of the mean that was fitted. Directions that J does not see (singular
/// values below `blind` of the largest) are taken to be as uncertain as the whole range.
void analyse_errors(Confidence& c, const Eigen::MatrixXd& noise_covariance, double blind = 1e-3);

} // namespace proveta
