#include "lab/calibrate/confidence.hpp"

#include <cmath>

namespace proveta {

void analyse_errors(Confidence& c, const Eigen::MatrixXd& noise_covariance, double blind) {
    const Eigen::Index n = c.jacobian.cols();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(c.jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::VectorXd& s = svd.singularValues();
    // Covariance of the estimate in the singular directions; one that the targets do not see is uniform over the cube's width.
    Eigen::MatrixXd inside = svd.matrixU().transpose() * noise_covariance * svd.matrixU();
    for (Eigen::Index a = 0; a < s.size(); ++a) {
        for (Eigen::Index b = 0; b < s.size(); ++b) {
            const bool seen = s[a] > blind * s[0] && s[b] > blind * s[0];
            inside(a, b) = seen ? inside(a, b) / (s[a] * s[b]) : a == b ? 1.0 / 12.0 : 0.0;
        }
    }
    Eigen::MatrixXd covariance = svd.matrixV() * inside * svd.matrixV().transpose();
    if (s.size() < n) { // fewer targets than parameters: the rest of space is not seen
        covariance += (Eigen::MatrixXd::Identity(n, n) - svd.matrixV() * svd.matrixV().transpose()) / 12.0;
    }
    c.standard_error.clear();
    c.correlation = Eigen::MatrixXd::Identity(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
        c.standard_error.push_back(std::sqrt(std::max(covariance(k, k), 0.0)));
    }
    for (Eigen::Index a = 0; a < n; ++a) {
        for (Eigen::Index b = 0; b < n; ++b) {
            const double scale = std::sqrt(covariance(a, a) * covariance(b, b));
            c.correlation(a, b) = a == b ? 1.0 : scale > 0.0 ? covariance(a, b) / scale : 0.0;
        }
    }
}

} // namespace proveta
