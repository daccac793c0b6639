#include "lab/surface_pressure.hpp"

#include "specimens/surface_net.hpp"

namespace proveta {

Pressure lateral_pressure(const Shape& shape, const Spheres& spheres, const Bonds& bonds) {
    const SurfaceNet net = side_net(shape, spheres, bonds);
    return make_pressure(spheres, net.sphere, net.raise, net.normal, net.facets, net.surface);
}

Pressure end_pressure(const Shape& shape, const Spheres& spheres, const Bonds& bonds, double outward) {
    const SurfaceNet net = end_net(shape, spheres, bonds, outward);
    return make_pressure(spheres, net.sphere, net.raise, net.normal, net.facets, net.surface);
}

} // namespace proveta
