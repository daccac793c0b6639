#include "lab/strength_scatter.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "specimens/random.hpp"

namespace proveta {

namespace {

// A Gaussian field of unit variance as a sum of waves of random direction and phase (Shinozuka, Deodatis, Appl. Mech. Rev. 44 (1991) 191).
class WaveField {
  public:
    WaveField(double length, Random& random) {
        const auto normal = [&] { // Box and Muller
            const double r = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
            return r * std::cos(2.0 * std::numbers::pi * random.uniform());
        };
        for (auto& wave : waves_) {
            for (int c = 0; c < 3; ++c) {
                wave.number[c] = normal() / length;
            }
            wave.phase = 2.0 * std::numbers::pi * random.uniform();
        }
    }
    [[nodiscard]] double at(const Vec3& x) const {
        double sum = 0.0;
        for (const auto& wave : waves_) {
            sum += std::cos(wave.number.dot(x) + wave.phase);
        }
        return sum * std::sqrt(2.0 / static_cast<double>(waves_.size()));
    }

  private:
    struct Wave {
        Vec3 number = Vec3::Zero(); // 1/m
        double phase = 0.0;
    };
    std::vector<Wave> waves_ = std::vector<Wave>(400);
};

// Quantile of Weibull's distribution with mean 1.
double weibull(double share, double modulus) { return std::pow(-std::log1p(-share), 1.0 / modulus) / std::tgamma(1.0 + 1.0 / modulus); }

} // namespace

std::vector<double> scattered_strengths(const Spheres& spheres, const Bonds& bonds, std::uint64_t seed) {
    std::vector<double> out;
    std::map<double, WaveField> fields; // by correlation length: materials that share one share the field
    for (const auto& block : bonds.blocks) {
        const auto* law = std::get_if<Facet::Constants>(&bonds.groups[block.group].law);
        if (law == nullptr || law->weibull_modulus <= 0.0) {
            continue;
        }
        out.resize(bonds.size(), 1.0);
        const double length = law->correlation_length;
        if (length > 0.0 && !fields.contains(length)) {
            Random random(seed, Stream::strengths);
            fields.emplace(length, WaveField(length, random));
        }
        for (auto b = block.begin; b < block.end; ++b) {
            const auto i = static_cast<std::size_t>(bonds.i[b]);
            const auto j = static_cast<std::size_t>(bonds.j[b]);
            double share = 0.5;
            if (length > 0.0) {
                const Vec3 middle = spheres.position.at(i) + bonds.share[b] * (spheres.position.at(j) - spheres.position.at(i));
                share = 0.5 * std::erfc(-fields.at(length).at(middle) / std::numbers::sqrt2);
            } else {
                const auto pair = static_cast<std::uint64_t>(spheres.id[i]) << 32 | static_cast<std::uint32_t>(spheres.id[j]);
                share = Random(seed ^ pair, Stream::strengths).uniform();
            }
            out[b] = weibull(std::clamp(share, 1e-12, 1.0 - 1e-12), law->weibull_modulus);
        }
    }
    return out;
}

} // namespace proveta
