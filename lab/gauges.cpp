#include "lab/gauges.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace proveta {

Gauges::Gauges(const Shape& shape, const Spheres& s) {
    const double length = std::min(shape.lateral_size(), 0.5 * shape.height);
    const double half_band =
        1.5 * std::accumulate(s.radius.begin(), s.radius.end(), 0.0) / std::max<double>(1.0, static_cast<double>(s.size()));
    const auto fill = [&](Band& band, double z) {
        for (std::size_t k = 0; k < s.size(); ++k) {
            if (std::fabs(s.start.z[k] - z) <= half_band) {
                band.spheres.push_back(k);
                band.start.push_back(s.start.z[k]);
                band.height += s.start.z[k];
            }
        }
        band.height /= std::max<double>(1.0, static_cast<double>(band.spheres.size()));
    };
    fill(lower_, 0.5 * (shape.height - length));
    fill(upper_, 0.5 * (shape.height + length));
    for (std::size_t k = 0; k < s.size(); ++k) {
        const Vec3 p = s.start.at(k);
        const bool at_side = shape.depth_below_side(p) < 1.2 * s.radius[k];
        if (at_side && std::fabs(p.z() - 0.5 * shape.height) <= shape.height / 12.0) {
            girth_.push_back(k);
            girth_radius_.push_back(std::hypot(p.x(), p.y()));
        }
    }
}

double Gauges::rise(const Band& band, const VectorField& position, const std::vector<std::uint8_t>& left_out) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t k = 0; k < band.spheres.size(); ++k) {
        if (left_out[band.spheres[k]] == 0) {
            sum += position.z[band.spheres[k]] - band.start[k];
            count += 1.0;
        }
    }
    return sum / std::max(1.0, count);
}

double Gauges::axial_strain(const VectorField& position, const std::vector<std::uint8_t>& left_out) const {
    return (rise(lower_, position, left_out) - rise(upper_, position, left_out)) / (upper_.height - lower_.height);
}

double Gauges::girth_strain(const VectorField& position, const std::vector<std::uint8_t>& left_out) const {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t k = 0; k < girth_.size(); ++k) {
        if (left_out[girth_[k]] == 0) {
            sum += 1.0 - std::hypot(position.x[girth_[k]], position.y[girth_[k]]) / girth_radius_[k];
            count += 1.0;
        }
    }
    return sum / std::max(1.0, count);
}

} // namespace proveta
