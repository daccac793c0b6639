#include "specimens/laguerre.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <voro++/voro++.hh>

namespace proveta {

namespace {

constexpr double smallest_facet = 1e-6; // of the raw area; less is round-off of the cuts

// A facet seen from one of its cells.
struct CellFace {
    Pair pair;
    double area;
    bool operator<(const CellFace& o) const { return pair < o.pair; }
};

// Spheres that the tessellation can take: inside the box, no two in one place.
std::vector<char> usable(const Shape& shape, const Spheres& s) {
    std::vector<char> good(s.size(), 1);
    for (std::size_t k = 0; k < s.size(); ++k) {
        const Vec3 p = s.position.at(k);
        good[k] = p.allFinite() && shape.depth_below_surface(p) > 0.0 ? 1 : 0;
    }
    for (const auto& [i, j] : find_pairs(s.position, s.radius, 1e-9, 0.0)) {
        good[static_cast<std::size_t>(j)] = 0;
    }
    return good;
}

} // namespace

LaguerreAreas laguerre_areas(const Shape& shape, const Spheres& s, const std::vector<Pair>& pairs) {
    const std::size_t n = s.size();
    LaguerreAreas out;
    out.areas.pair.assign(pairs.size(), 0.0);
    out.areas.weight.assign(n, 1.0);
    out.cell.assign(n, 0.0);
    if (n == 0) {
        return out;
    }
    const bool round = shape.kind == ShapeKind::cylinder;
    const double mean = std::accumulate(s.radius.begin(), s.radius.end(), 0.0) / static_cast<double>(n);
    // Areas of a plate's facets do not depend on the thickness of the slab that is cut; cells of even shape are cut best.
    const double thickness = shape.planar() ? 2.0 * mean : 1.0;
    const double half_x = 0.5 * (round ? shape.diameter : shape.width);
    const double half_y = shape.planar() ? 0.5 * thickness : 0.5 * (round ? shape.diameter : shape.depth);
    const double volume = 4.0 * half_x * half_y * shape.height;
    const double block = std::cbrt(5.0 * volume / static_cast<double>(n)); // Voro++ is fastest at about five spheres a block
    const auto blocks = [&](double length) { return std::clamp(static_cast<int>(length / block), 1, 512); };

    voro::container_poly box(-half_x, half_x, -half_y, half_y, 0.0, shape.height, blocks(2.0 * half_x), blocks(2.0 * half_y),
                             blocks(shape.height), false, false, false, 8);
    voro::wall_cylinder wall(0.0, 0.0, 0.0, 0.0, 0.0, 1.0, half_x);
    if (round) {
        box.add_wall(wall);
    }
    const auto good = usable(shape, s);
    for (std::size_t k = 0; k < n; ++k) {
        if (good[k] != 0) {
            box.put(static_cast<int>(k), s.position.x[k], s.position.y[k], s.position.z[k], s.radius[k]);
        }
    }

    std::vector<CellFace> facets;
    std::vector<int> beyond;
    std::vector<double> area;
    std::vector<char> has_cell(n, 0);
    voro::c_loop_all loop(box);
    if (loop.start()) {
        do {
            voro::voronoicell_neighbor cell;
            const int i = loop.pid();
            if (!box.compute_cell(cell, loop)) {
                continue;
            }
            has_cell[static_cast<std::size_t>(i)] = 1;
            out.cell[static_cast<std::size_t>(i)] = cell.volume() / (shape.planar() ? thickness : 1.0);
            cell.neighbors(beyond);
            cell.face_areas(area);
            for (std::size_t f = 0; f < beyond.size(); ++f) {
                const int j = beyond[f];
                if (j >= 0 && j != i) { // below 0: the surface
                    facets.push_back({{std::min(i, j), std::max(i, j)}, area[f] / thickness});
                }
            }
        } while (loop.inc());
    }
    out.without_cell = n - static_cast<std::size_t>(std::count(has_cell.begin(), has_cell.end(), 1));
    out.volume_ratio = std::accumulate(out.cell.begin(), out.cell.end(), 0.0) / shape.volume();

    // The two cells of a facet are cut one by one and see it with different round-off, or one of them not at all: take the mean of both.
    std::stable_sort(facets.begin(), facets.end());
    std::vector<CellFace> merged;
    for (const auto& f : facets) {
        if (merged.empty() || !(merged.back().pair == f.pair)) {
            merged.push_back({f.pair, 0.0});
        }
        merged.back().area += 0.5 * f.area;
    }
    std::vector<double> surface(n, 0.0);
    std::vector<double> raw(n, 0.0);
    double all = 0.0;
    double bonded = 0.0;
    for (const auto& f : merged) {
        all += f.area;
        surface[static_cast<std::size_t>(f.pair.i)] += f.area;
        surface[static_cast<std::size_t>(f.pair.j)] += f.area;
    }
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto i = static_cast<std::size_t>(pairs[k].i);
        const auto j = static_cast<std::size_t>(pairs[k].j);
        const double cone = raw_area(AreaRule::laguerre, s, i, j);
        raw[i] += cone;
        raw[j] += cone;
        const auto at = std::lower_bound(merged.begin(), merged.end(), CellFace{pairs[k], 0.0});
        const bool found = at != merged.end() && at->pair == pairs[k] && at->area > smallest_facet * cone;
        if (found) {
            out.areas.pair[k] = at->area;
            bonded += at->area;
        } else {
            ++out.facetless;
        }
    }
    out.unbonded_share = all > 0.0 ? 1.0 - bonded / all : 0.0;

    double sum = 0.0;
    double count = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
        if (raw[k] > 0.0 && surface[k] > 0.0) {
            out.areas.weight[k] = surface[k] / raw[k];
            sum += out.areas.weight[k];
            count += 1.0;
        }
    }
    for (std::size_t k = 0; k < n && count > 0.0; ++k) {
        if (!(raw[k] > 0.0 && surface[k] > 0.0)) {
            out.areas.weight[k] = sum / count;
        }
    }
    return out;
}

} // namespace proveta
