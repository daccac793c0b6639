#include "core/bonds/dilatation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/bonds/bonds.hpp"
#include "core/contacts/pair_kinematics.hpp"

namespace proveta {

std::vector<double> tributary_volumes(const Spheres& s, const Bonds& b) {
    std::vector<double> volume(s.size(), 0.0);
    const double dimensions = s.planar ? 2.0 : 3.0; // of a cone's height
    for (std::size_t k = 0; k < b.size(); ++k) {
        const double share = b.share[k];
        volume[static_cast<std::size_t>(b.i[k])] += b.area[k] * share * b.length[k] / dimensions;
        volume[static_cast<std::size_t>(b.j[k])] += b.area[k] * (1.0 - share) * b.length[k] / dimensions;
    }
    for (std::size_t k = 0; k < s.size(); ++k) {
        if (volume[k] <= 0.0) {
            volume[k] = s.volume(k);
        }
    }
    return volume;
}

VolumeShares volume_shares(const Bonds& b, const std::vector<double>& volume) {
    VolumeShares g{std::vector<double>(b.size()), std::vector<double>(b.size())};
    for (std::size_t k = 0; k < b.size(); ++k) {
        g.i[k] = b.area[k] * b.share[k] / volume[static_cast<std::size_t>(b.i[k])];
        g.j[k] = b.area[k] * (1.0 - b.share[k]) / volume[static_cast<std::size_t>(b.j[k])];
    }
    return g;
}

void set_dilatation(const Spheres& spheres, const std::vector<double>& modulus, Bonds& b) {
    b.dilatation = {};
    if (std::all_of(modulus.begin(), modulus.end(), [](double m) { return m == 0.0; })) {
        return;
    }
    Dilatation& d = b.dilatation;
    const auto volume = tributary_volumes(spheres, b);
    d.stiffness.resize(spheres.size());
    d.theta.assign(spheres.size(), 0.0);
    for (std::size_t k = 0; k < spheres.size(); ++k) {
        d.stiffness[k] = modulus[k] * volume[k];
    }
    for (auto* array : {&d.shift, &d.shift_before, &d.elongation, &d.following}) {
        array->assign(b.size(), 0.0);
    }
    auto g = volume_shares(b, volume);
    d.g_i = std::move(g.i);
    d.g_j = std::move(g.j);
}

void measure_elongations(const Spheres& s, Bonds& b, std::size_t begin, std::size_t end) {
    Dilatation& d = b.dilatation;
    for (std::size_t k = begin; k < end; ++k) {
        const auto i = static_cast<std::size_t>(b.i[k]);
        const auto j = static_cast<std::size_t>(b.j[k]);
        double e =
            distance_at_rest(s.position.x[j] - s.position.x[i], s.position.y[j] - s.position.y[i], s.position.z[j] - s.position.z[i]) -
            b.length[k];
        d.following[k] = 0.0;
        if (b.worn[k] != 0) {
            e += b.memory[0][k];
            if (e + d.shift[k] > 0.0) { // of an elongation that damage has left the share 1 - d of its force
                const double left = b.mode[k] != 0 ? 0.0 : 1.0 - b.memory[1][k];
                e *= left;
                d.following[k] = 1.0 - left;
            }
        }
        d.elongation[k] = e;
    }
}

void measure_dilatation(Bonds& b, std::size_t begin, std::size_t end) {
    Dilatation& d = b.dilatation;
    for (std::size_t k = begin; k < end; ++k) {
        double sum = 0.0;
        double own = 1.0; // a sphere's own part in the shifts of open bonds is solved for, that of its neighbours is the last one
        for (auto e = b.incidence.offset[k]; e < b.incidence.offset[k + 1]; ++e) {
            const auto bond = b.incidence.entry[e] >> 1;
            const double g = (b.incidence.entry[e] & 1u) != 0 ? d.g_j[bond] : d.g_i[bond];
            sum += g * d.elongation[bond];
            if (d.following[bond] > 0.0) {
                const double by_own = d.stiffness[k] * g / b.stiffness[bond];
                sum -= g * d.following[bond] * (d.shift[bond] - by_own * d.theta[k]);
                own += g * d.following[bond] * by_own;
            }
        }
        d.theta[k] = sum / own;
    }
}

void set_shifts(Bonds& b, std::size_t begin, std::size_t end) {
    Dilatation& d = b.dilatation;
    for (std::size_t k = begin; k < end; ++k) {
        const auto i = static_cast<std::size_t>(b.i[k]);
        const auto j = static_cast<std::size_t>(b.j[k]);
        d.shift_before[k] = d.shift[k];
        d.shift[k] = (d.stiffness[i] * d.theta[i] * d.g_i[k] + d.stiffness[j] * d.theta[j] * d.g_j[k]) / b.stiffness[k];
    }
}

double dilatation_energy(const Bonds& b) {
    const Dilatation& d = b.dilatation;
    double sum = 0.0;
    for (std::size_t k = 0; k < d.stiffness.size(); ++k) {
        sum -= 0.5 * d.stiffness[k] * d.theta[k] * d.theta[k];
    }
    for (std::size_t k = 0; k < d.shift.size(); ++k) {
        sum -= 0.5 * b.stiffness[k] * d.shift[k] * d.shift[k];
    }
    return sum;
}

std::vector<double> stiffening(const Bonds& b) {
    const Dilatation& d = b.dilatation;
    std::vector<double> factor(b.size(), 1.0);
    if (!d.active()) {
        return factor;
    }
    std::vector<double> all(d.stiffness.size(), 0.0);
    for (std::size_t k = 0; k < b.size(); ++k) {
        all[static_cast<std::size_t>(b.i[k])] += d.g_i[k];
        all[static_cast<std::size_t>(b.j[k])] += d.g_j[k];
    }
    for (std::size_t k = 0; k < b.size(); ++k) {
        const auto i = static_cast<std::size_t>(b.i[k]);
        const auto j = static_cast<std::size_t>(b.j[k]);
        factor[k] +=
            (std::max(d.stiffness[i], 0.0) * d.g_i[k] * all[i] + std::max(d.stiffness[j], 0.0) * d.g_j[k] * all[j]) / b.stiffness[k];
    }
    return factor;
}

} // namespace proveta
