#include "lab/elastic/pressable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "lab/axial_results.hpp"
#include "lab/fragments.hpp"

namespace proveta {

namespace {

// Of an end's area, the sections of the spheres that the platen touches. A packing that was made between walls has 0.8 to 1, a cut that
// touches a few proud spheres some hundredths.
constexpr double least_cover = 0.25;
constexpr std::size_t fewest = 3;    // that hold a plane; two hold a line
constexpr double whole_piece = 0.95; // of the spheres

// Spheres that a platen touches, and their sections over the end's.
struct Touched {
    std::vector<std::size_t> sphere;
    double cover = 0.0;
};

std::vector<Touched> touched(const Shape& shape, const Spheres& spheres) {
    std::vector<Touched> out;
    for (const auto& platen : axial_press(spheres, shape, 0.0, 1.0).platens) {
        Touched end;
        for (std::size_t k = 0; k < spheres.size(); ++k) {
            if (platen.capped[k] > 0.0) {
                end.sphere.push_back(k);
                end.cover += spheres.section(k) / shape.section();
            }
        }
        out.push_back(std::move(end));
    }
    return out;
}

std::string text_of(const std::vector<Touched>& ends) {
    return fmt::format("the platens touch {} and {} spheres ({:.2g} and {:.2g} of the ends' area)", ends[0].sphere.size(),
                       ends[1].sphere.size(), ends[0].cover, ends[1].cover);
}

} // namespace

std::string touched_spheres(const Shape& shape, const Spheres& spheres) { return text_of(touched(shape, spheres)); }

std::optional<std::string> not_pressable(const Shape& shape, const Spheres& spheres, const Bonds& bonds) {
    const auto ends = touched(shape, spheres);
    const std::size_t least = spheres.planar ? fewest - 1 : fewest;
    if (std::any_of(ends.begin(), ends.end(), [&](const Touched& t) { return t.sphere.size() < least || t.cover < least_cover; })) {
        return fmt::format("{}; at least {} and {} of the area take part in pressing a solid body", text_of(ends), least, least_cover);
    }
    const auto piece = fragments(bonds, spheres.size());
    const auto size = fragment_sizes(piece);
    const auto single = std::count(size.begin(), size.end(), std::size_t{1});
    const bool spans = std::all_of(ends.begin(), ends.end(), [&](const Touched& t) {
        return std::any_of(t.sphere.begin(), t.sphere.end(), [&](std::size_t k) { return piece[k] == 0; }); // the largest
    });
    if (!spans || static_cast<double>(size.front()) < whole_piece * static_cast<double>(spheres.size())) {
        return fmt::format("its bonds leave it in {} pieces, {} of them single spheres; the largest has {} of {} spheres{}", size.size(),
                           single, size.front(), spheres.size(), spans ? "" : " and does not reach from platen to platen");
    }
    return std::nullopt;
}

} // namespace proveta
