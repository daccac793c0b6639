// How far spheres have gone since a search.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/geometry/vector_field.hpp"

namespace proveta {

/// Bounds the longest way of any sphere since `restart`: by the sum of the highest speeds, which costs nothing, and, where that is not
/// enough, by looking at every sphere.
struct Travel {
    double bound = 0.0; ///< m
    VectorField from;   ///< positions at the last restart, m

    void went(double way) { bound += way; }

    /// Whether some sphere may have gone farther than `limit` metres.
    bool beyond(double limit, const VectorField& now) {
        if (bound <= limit) {
            return false;
        }
        double farthest = 0.0;
        for (std::size_t k = 0; k < now.size(); ++k) {
            farthest = std::max(farthest, (now.at(k) - from.at(k)).squaredNorm());
        }
        bound = std::sqrt(farthest);
        return bound > limit;
    }

    void restart(const VectorField& now) {
        from = now;
        bound = 0.0;
    }
};

} // namespace proveta
