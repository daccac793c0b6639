#include "lab/sweep/design.hpp"

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

#include "lab/trials/uniform.hpp"

namespace proveta {

namespace {

// Random numbers that are the same everywhere: the standard fixes the engine, but not what its distributions make of it.
class Draws {
  public:
    explicit Draws(std::uint64_t seed) : engine_(seed) {}

    // 0 <= u < 1, of the upper 53 bits.
    double uniform() { return proveta::uniform(engine_); }
    // 0 to n - 1.
    std::size_t below(std::size_t n) { return std::min(n - 1, static_cast<std::size_t>(uniform() * static_cast<double>(n))); }
    // 0 to n - 1 in random order (Fisher and Yates).
    std::vector<std::size_t> permutation(std::size_t n) {
        std::vector<std::size_t> out(n);
        std::iota(out.begin(), out.end(), std::size_t{0});
        for (std::size_t k = n; k > 1; --k) {
            std::swap(out[k - 1], out[below(k)]);
        }
        return out;
    }

  private:
    std::mt19937_64 engine_;
};

} // namespace

std::vector<Point> grid(const std::vector<std::vector<double>>& levels) {
    std::vector<Point> out{{}};
    for (const auto& of_parameter : levels) {
        std::vector<Point> longer;
        for (const auto& point : out) {
            for (const double level : of_parameter) {
                longer.push_back(point);
                longer.back().push_back(level);
            }
        }
        out = std::move(longer);
    }
    return out;
}

std::vector<Point> latin_hypercube(std::size_t n, std::size_t parameters, std::uint64_t seed) {
    Draws random(seed);
    std::vector<Point> out(n, Point(parameters));
    for (std::size_t k = 0; k < parameters; ++k) {
        const auto stratum = random.permutation(n);
        for (std::size_t i = 0; i < n; ++i) {
            out[i][k] = (static_cast<double>(stratum[i]) + random.uniform()) / static_cast<double>(n);
        }
    }
    return out;
}

std::vector<Point> sobol(std::size_t n, std::size_t parameters) {
    if (parameters == 0 || parameters > 3667) {
        throw std::invalid_argument("Sobol's sequence for 1 to 3667 parameters");
    }
    boost::random::sobol sequence(parameters); // leaves the origin out by itself
    std::vector<Point> out(n, Point(parameters));
    for (auto& point : out) {
        for (double& u : point) {
            u = std::ldexp(static_cast<double>(sequence()), -64);
        }
    }
    return out;
}

std::vector<Point> morris(std::size_t trajectories, std::size_t parameters, std::size_t levels, std::uint64_t seed) {
    if (levels < 2 || levels % 2 != 0) {
        throw std::invalid_argument("Morris' design with an even number of levels");
    }
    Draws random(seed);
    const std::size_t jump = levels / 2; // in levels: the standard step, with which all levels are equally frequent
    const auto coordinate = [&](std::size_t level) { return static_cast<double>(level) / static_cast<double>(levels - 1); };
    std::vector<Point> out;
    for (std::size_t t = 0; t < trajectories; ++t) {
        std::vector<std::size_t> at(parameters);
        for (auto& level : at) {
            level = random.below(levels);
        }
        const auto add = [&] {
            out.emplace_back();
            for (const auto level : at) {
                out.back().push_back(coordinate(level));
            }
        };
        add();
        for (const auto k : random.permutation(parameters)) {
            at[k] = at[k] < jump ? at[k] + jump : at[k] - jump; // one of the two leads out of the cube
            add();
        }
    }
    return out;
}

} // namespace proveta
