#include "lab/calibrate/search.hpp"

#include <dlib/global_optimization/global_function_search.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "lab/trials/uniform.hpp"

namespace proveta {

namespace {

using Point = std::vector<double>;

// Nearer than this to a trial that there is, a point would say nothing new.
constexpr double too_near = 2e-3;
constexpr double wide_radius = 0.4; // of a model that sees most of the cube

std::vector<Point> propose_globally(const std::vector<SearchPoint>& samples, std::size_t dimensions, std::size_t count,
                                    std::uint64_t seed) {
    const auto n = static_cast<long>(dimensions);
    const dlib::function_spec cube(dlib::zeros_matrix<double>(n, 1), dlib::ones_matrix<double>(n, 1));
    std::vector<dlib::function_evaluation> known;
    for (const auto& s : samples) {
        dlib::matrix<double, 0, 1> x(n);
        std::copy(s.u.begin(), s.u.end(), x.begin());
        known.emplace_back(x, -std::log1p(s.score() * s.score()));
    }
    dlib::global_function_search search({cube}, {known});
    search.set_seed(static_cast<time_t>(seed));
    std::vector<dlib::function_evaluation_request> asked; // until all are, so that they keep apart
    std::vector<Point> out;
    for (std::size_t k = 0; k < count; ++k) {
        asked.push_back(search.get_next_x());
        out.emplace_back(asked.back().x().begin(), asked.back().x().end());
    }
    for (auto& request : asked) {
        request.set(0.0); // an answer is owed, to nobody
    }
    return out;
}

std::vector<Point> propose_at_random(std::size_t dimensions, std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<Point> out(count, Point(dimensions));
    for (auto& point : out) {
        for (double& u : point) {
            u = uniform(random);
        }
    }
    return out;
}

// Distance from the best within which so many trials lie that a model can be told from them.
double radius_around(const Point& best, const std::vector<SearchPoint>& samples) {
    std::vector<double> distances;
    for (const auto& s : samples) {
        distances.push_back(chebyshev(s.u, best));
    }
    std::sort(distances.begin(), distances.end());
    const std::size_t wanted = std::min(distances.size() - 1, 2 * best.size() + 2);
    return std::clamp(distances[wanted], 0.05, 0.5);
}

std::vector<Point> propose_by_models(const std::vector<SearchPoint>& samples, std::size_t count, std::uint64_t seed) {
    std::vector<SearchPoint> complete;
    std::copy_if(samples.begin(), samples.end(), std::back_inserter(complete), [](const SearchPoint& s) { return s.complete; });
    const Point centre = samples[best_sample(samples)].u;
    const double near = radius_around(centre, complete);
    std::vector<Point> out;
    for (std::size_t k = 0; k < count; ++k) {
        // In turn a wide model, which averages the noise of all trials out and leads out of valleys that are none, and a near one, which is
        // right about what is around the best.
        const bool wide = k % 2 == 0;
        const double radius = wide ? wide_radius : near;
        const ResidualModel model(samples, centre, radius);
        const std::size_t nearer = 1 + k / 2;
        out.push_back(model.best((wide ? 2.0 : 1.0) * radius / static_cast<double>(nearer), seed + k));
    }
    return out;
}

// Moves points that repeat an earlier one a little aside.
void keep_apart(std::vector<Point>& points, const std::vector<SearchPoint>& samples, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const auto repeats = [&] {
            const auto near = [&](const Point& other) { return chebyshev(points[k], other) < too_near; };
            return std::any_of(samples.begin(), samples.end(), [&](const SearchPoint& s) { return near(s.u); }) ||
                   std::any_of(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(k), near);
        };
        for (double aside = 0.02; repeats(); aside *= 1.5) {
            for (double& u : points[k]) {
                u = std::clamp(u + aside * (2.0 * uniform(random) - 1.0), 0.0, 1.0);
            }
        }
    }
}

} // namespace

std::size_t best_sample(const std::vector<SearchPoint>& samples) {
    std::size_t best = samples.size();
    for (std::size_t k = 0; k < samples.size(); ++k) {
        if (samples[k].complete && (best == samples.size() || samples[k].score() < samples[best].score())) {
            best = k;
        }
    }
    return best;
}

std::vector<Point> propose(const std::vector<SearchPoint>& samples, std::size_t dimensions, std::size_t count, const std::string& method,
                           std::uint64_t seed) {
    if (samples.empty()) {
        return propose_at_random(dimensions, count, seed);
    }
    const auto complete =
        static_cast<std::size_t>(std::count_if(samples.begin(), samples.end(), [](const SearchPoint& s) { return s.complete; }));
    const bool ready = complete >= dimensions + 2; // for models
    const std::size_t by_models = !ready || method == "global" ? 0 : method == "models" ? count : (count + 1) / 2;
    std::vector<Point> out;
    if (by_models > 0) {
        out = propose_by_models(samples, by_models, seed);
    }
    if (by_models < count) {
        auto more = propose_globally(samples, dimensions, count - by_models, seed);
        out.insert(out.end(), more.begin(), more.end());
    }
    keep_apart(out, samples, seed);
    return out;
}

} // namespace proveta
