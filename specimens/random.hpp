// Random numbers that are the same on every machine: the standard fixes the engine's output but not that of its distributions.
#pragma once

#include <cstdint>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace proveta {

/// What a stream of random numbers is for. Streams of one seed are independent, so that a new use never disturbs an old one.
enum class Stream : std::uint64_t { radii = 1, positions = 2, stones = 3, attitudes = 4, strengths = 5 };

class Random {
  public:
    Random(std::uint64_t seed, Stream stream) {
        std::seed_seq mix{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32), static_cast<std::uint32_t>(stream)};
        engine_.seed(mix);
    }

    /// Uniform in [0, 1).
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }

    template <class T> void shuffle(std::vector<T>& items) {
        for (std::size_t k = items.size(); k > 1; --k) {
            std::swap(items[k - 1], items[static_cast<std::size_t>(uniform() * static_cast<double>(k))]);
        }
    }

    /// Names where it stands in its stream, for a checkpoint.
    template <class Visit> void visit_state(const std::string& name, Visit&& visit) {
        std::ostringstream out;
        out << engine_;
        std::string text = out.str();
        visit(name, text);
        std::istringstream(text) >> engine_;
    }

  private:
    std::mt19937_64 engine_;
};

} // namespace proveta
