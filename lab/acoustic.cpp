#include "lab/acoustic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <unordered_map>

namespace proveta {

namespace {

// Cubes as wide as the reach, by their place; only those with failures exist, so that a piece flung far away costs nothing.
using Cell = std::array<std::int64_t, 3>;

struct CellHash {
    std::size_t operator()(const Cell& cell) const {
        std::uint64_t h = 0;
        for (const std::int64_t v : cell) {
            h = (h ^ static_cast<std::uint64_t>(v)) * 0x9e3779b97f4a7c15u; // odd and without pattern: 2^64 over the golden ratio
            h ^= h >> 29;
        }
        return h;
    }
};

Cell cell_of(const Vec3& position, double width) {
    const Vec3 place = position / width;
    return {static_cast<std::int64_t>(std::floor(place.x())), static_cast<std::int64_t>(std::floor(place.y())),
            static_cast<std::int64_t>(std::floor(place.z()))};
}

// Sets that grow together; each is known by its root.
class Groups {
  public:
    explicit Groups(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::uint32_t{0}); }

    std::uint32_t root(std::uint32_t k) {
        while (parent_[k] != k) {
            parent_[k] = parent_[parent_[k]];
            k = parent_[k];
        }
        return k;
    }
    void join(std::uint32_t a, std::uint32_t b) { parent_[root(a)] = root(b); }

  private:
    std::vector<std::uint32_t> parent_;
};

// What is compared of a failure, close together in memory.
struct Heard {
    double time;
    Vec3 position;
    std::uint32_t failure;
};

// Joins what is linked. The failures are sorted by time.
Groups link(const std::vector<FailureEvent>& failures, const AcousticRule& rule) {
    const double distance = rule.distance();
    const double duration = rule.duration();
    Groups groups(failures.size());
    std::unordered_map<Cell, std::vector<Heard>, CellHash> so_far; // the latest at the end
    for (std::uint32_t k = 0; k < failures.size(); ++k) {
        const FailureEvent& now = failures[k];
        const Cell own = cell_of(now.position, distance);
        for (int shift = 0; shift < 27; ++shift) {
            const auto near = so_far.find({own[0] + shift % 3 - 1, own[1] + shift / 3 % 3 - 1, own[2] + shift / 9 - 1});
            if (near == so_far.end()) {
                continue;
            }
            for (auto then = near->second.rbegin(); then != near->second.rend() && now.time - then->time <= duration; ++then) {
                if ((now.position - then->position).squaredNorm() <= distance * distance) {
                    groups.join(k, then->failure);
                }
            }
        }
        so_far[own].push_back({now.time, now.position, k});
    }
    return groups;
}

// The event of some failures, which are in the order of time.
AcousticEvent event_of(const std::vector<FailureEvent>& failures) {
    const FailureEvent& first = failures.front();
    const auto n = static_cast<double>(failures.size());
    AcousticEvent e{};
    e.start = first.time;
    e.duration = failures.back().time - first.time;
    e.axial_strain = first.axial_strain;
    e.bonds = failures.size();
    for (const auto& f : failures) {
        e.energy += f.energy;
        e.tension += f.mode == FailureMode::tension ? 1.0 : 0.0;
    }
    e.tension /= n;
    e.magnitude = energy_magnitude(e.energy);
    const auto weight = [&](const FailureEvent& f) { return e.energy > 0.0 ? f.energy / e.energy : 1.0 / n; };
    Vec3 centre = Vec3::Zero(); // from the first, so that a single failure is its own centre to the last bit
    for (const auto& f : failures) {
        centre += weight(f) * (f.position - first.position);
    }
    e.centre = first.position + centre;
    double square = 0.0;
    for (const auto& f : failures) {
        square += weight(f) * (f.position - e.centre).squaredNorm();
    }
    e.radius = std::sqrt(square);
    return e;
}

} // namespace

std::optional<double> energy_magnitude(double energy) {
    return energy > 0.0 ? std::optional((std::log10(energy) - 4.8) / 1.5) : std::nullopt;
}

std::vector<AcousticEvent> acoustic_events(const std::vector<FailureEvent>& failures, const AcousticRule& rule) {
    if (!(rule.distance() > 0.0 && rule.duration() > 0.0)) {
        throw std::invalid_argument("acoustic events need a positive diameter, wave speed, reach and patience");
    }
    std::vector<FailureEvent> in_time = failures;
    std::stable_sort(in_time.begin(), in_time.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
    Groups groups = link(in_time, rule);

    std::vector<std::vector<FailureEvent>> members; // of the events, by their first failures
    std::unordered_map<std::uint32_t, std::size_t> event_of_root;
    for (std::uint32_t k = 0; k < in_time.size(); ++k) {
        const auto [at, is_new] = event_of_root.try_emplace(groups.root(k), members.size());
        if (is_new) {
            members.emplace_back();
        }
        members[at->second].push_back(in_time[k]);
    }
    std::vector<AcousticEvent> events;
    events.reserve(members.size());
    std::transform(members.begin(), members.end(), std::back_inserter(events), event_of);
    return events;
}

std::vector<double> magnitudes_of(const std::vector<AcousticEvent>& events) {
    std::vector<double> out;
    for (const auto& e : events) {
        if (e.magnitude) {
            out.push_back(*e.magnitude);
        }
    }
    return out;
}

Outcome<MagnitudeLaw> magnitude_law(const std::vector<double>& magnitudes) {
    constexpr double width = 0.1;
    constexpr std::ptrdiff_t fewest = 50;
    const auto bin_of = [](double m) { return std::floor(m / width + 0.5); };
    std::vector<double> sorted = magnitudes;
    std::sort(sorted.begin(), sorted.end());
    auto from = sorted.begin(); // of the fullest bin
    std::ptrdiff_t count = 0;
    for (auto at = sorted.begin(); at != sorted.end();) {
        const auto next = std::find_if(at, sorted.end(), [&, bin = bin_of(*at)](double m) { return bin_of(m) > bin; });
        if (next - at > count) {
            count = next - at;
            from = at;
        }
        at = next;
    }
    if (sorted.end() - from < fewest) {
        return {std::nullopt, "fewer than 50 events of the magnitude of completeness or more"};
    }
    if (bin_of(sorted.back()) == bin_of(*from)) {
        return {std::nullopt, "the magnitudes do not differ"};
    }
    const auto n = static_cast<double>(sorted.end() - from);
    const double completeness = (bin_of(*from) - 0.5) * width;
    const double mean = std::accumulate(from, sorted.end(), 0.0, [&](double sum, double m) { return sum + (m - completeness) / n; });
    const double squares = std::accumulate(
        from, sorted.end(), 0.0, [&](double sum, double m) { return sum + (m - completeness - mean) * (m - completeness - mean); });
    const double b = std::numbers::log10e / mean;
    return {MagnitudeLaw{b, std::numbers::ln10 * b * b * std::sqrt(squares / (n * (n - 1.0))), completeness, static_cast<std::size_t>(n)},
            ""};
}

} // namespace proveta
