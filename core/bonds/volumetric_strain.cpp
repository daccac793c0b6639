#include "core/bonds/volumetric_strain.hpp"

#include <utility>

#include "core/bonds/bonds.hpp"
#include "core/contacts/pair_kinematics.hpp"

namespace proveta {

VolumetricStrain volumetric_strain(const Spheres& spheres, const Bonds& b) {
    VolumetricStrain out;
    out.strain.assign(spheres.size(), 0.0);
    auto g = volume_shares(b, tributary_volumes(spheres, b));
    for (auto* weights : {&g.i, &g.j}) {
        for (double& weight : *weights) {
            weight /= spheres.planar ? 2.0 : 3.0;
        }
    }
    out.weight_i = std::move(g.i);
    out.weight_j = std::move(g.j);
    return out;
}

void measure_volumetric_strain(const Spheres& s, Bonds& b, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
        double sum = 0.0;
        for (auto e = b.incidence.offset[k]; e < b.incidence.offset[k + 1]; ++e) {
            const auto bond = b.incidence.entry[e] >> 1;
            const bool second = (b.incidence.entry[e] & 1u) != 0;
            const auto i = static_cast<std::size_t>(b.i[bond]);
            const auto j = static_cast<std::size_t>(b.j[bond]);
            const double elongation =
                distance_at_rest(s.position.x[j] - s.position.x[i], s.position.y[j] - s.position.y[i], s.position.z[j] - s.position.z[i]) -
                b.length[bond];
            const double averaged = b.dilatation.active() ? b.dilatation.shift[bond] : 0.0; // which the law sees, too
            sum += (second ? b.volumetric.weight_j : b.volumetric.weight_i)[bond] * (elongation + averaged);
        }
        b.volumetric.strain[k] = sum;
    }
}

} // namespace proveta
