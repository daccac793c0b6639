// A model of the single deviations from the targets, near the best trial.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

namespace proveta {

/// A trial as the search sees it.
struct SearchPoint {
    std::vector<double> u;         ///< in the unit cube
    std::vector<double> deviation; ///< of all fitted targets (`Deviations::all`)
    bool complete = true;          ///< nothing in the deviations stands for a missing result

    [[nodiscard]] double score() const;
};

/// Quadratic polynomials for every deviation by itself, fitted to the trials around a centre: weights fall off beyond `radius`, and a small
/// ridge keeps terms at zero that the trials say nothing of. A sum of squares of fitted deviations knows where it goes to zero, which a
/// model of the sum does not (Gauss-Newton against Newton); it needs no more trials than there are parameters to begin with.
class ResidualModel {
  public:
    /// samples: at least two complete ones; those that are not tell where none is to be expected. radius: in the unit cube.
    ResidualModel(const std::vector<SearchPoint>& samples, std::vector<double> centre, double radius);

    /// Square of the score expected at u.
    [[nodiscard]] double square(const std::vector<double>& u) const;
    /// The least expected score within `reach` of the centre along each axis, inside the cube, where the nearest trial is a complete one.
    /// seed: of its random starts.
    [[nodiscard]] std::vector<double> best(double reach, std::uint64_t seed) const;

  private:
    [[nodiscard]] Eigen::VectorXd features(const std::vector<double>& u) const;
    [[nodiscard]] bool promising(const std::vector<double>& u) const;

    const std::vector<SearchPoint>& samples_;
    std::vector<double> centre_;
    double radius_;
    Eigen::MatrixXd coefficients_; // features x deviations
};

/// Largest difference of two points along an axis.
double chebyshev(const std::vector<double>& a, const std::vector<double>& b);

} // namespace proveta
