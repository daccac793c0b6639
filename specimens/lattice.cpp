#include "specimens/lattice.hpp"

#include <cmath>
#include <numbers>

namespace proveta {

namespace {

Specimen lattice(const char* name, std::size_t columns, std::size_t rows, double r, double rise, std::size_t fewer) {
    Specimen s;
    s.shape.kind = ShapeKind::plate;
    s.shape.width = 2.0 * r * static_cast<double>(columns);
    s.shape.height = 2.0 * r + rise * static_cast<double>(rows - 1);
    for (std::size_t row = 0; row < rows; ++row) {
        const std::size_t here = columns - (row % 2) * fewer;
        for (std::size_t k = 0; k < here; ++k) {
            s.spheres.centre.push_back(
                {r * (2.0 * static_cast<double>(k) + 1.0 - static_cast<double>(here)), 0.0, r + rise * static_cast<double>(row)});
            s.spheres.radius.push_back(r);
        }
    }
    s.group.assign(s.size(), 0);
    s.recipe = {{"lattice", name}, {"columns", columns}, {"rows", rows}, {"radius", r}};
    return s;
}

} // namespace

Specimen square_lattice(std::size_t columns, std::size_t rows, double r) { return lattice("square", columns, rows, r, 2.0 * r, 0); }

Specimen hexagonal_lattice(std::size_t columns, std::size_t rows, double r) {
    return lattice("hexagonal", columns, rows, r, std::numbers::sqrt3 * r, 1);
}

} // namespace proveta
