#include "lab/specimen_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/angles.hpp"
#include "lab/crack_report.hpp"
#include "specimens/grading.hpp"

namespace proveta {

namespace {

// Diameters of the particles, of stones those of the spheres of their volumes, m.
std::vector<double> diameters_of(const Specimen& s) {
    std::vector<double> out;
    for (const auto& stone : s.stones) {
        out.push_back(stone.size);
    }
    for (std::size_t k = 0; k < s.spheres.radius.size() && s.stones.empty(); ++k) {
        out.push_back(2.0 * s.spheres.radius[k]);
    }
    return out;
}

// Passing by mass, thinned to what a line needs.
report::Curve sieve_line(const std::string& name, std::vector<double> diameters, double power) {
    constexpr std::size_t most = 120;
    report::Curve c{name, {}, {}};
    std::sort(diameters.begin(), diameters.end());
    double total = 0.0;
    for (const double d : diameters) {
        total += std::pow(d, power);
    }
    double passed = 0.0;
    for (std::size_t k = 0; k < diameters.size(); ++k) {
        passed += std::pow(diameters[k], power);
        if (k % (diameters.size() / most + 1) == 0 || k + 1 == diameters.size()) {
            c.x.push_back(1e3 * diameters[k]);
            c.y.push_back(100.0 * passed / total);
        }
    }
    return c;
}

std::vector<SievePoint> points_of(const input::Json& grading) {
    std::vector<SievePoint> out;
    for (const auto& p : grading) {
        out.push_back({p.at("diameter").get<double>(), p.at("passing").get<double>()});
    }
    return out;
}

// Diameters that a recipe asks for, as large on the whole as those there are; none where the recipe is not known.
std::vector<double> wanted(const Specimen& s, const std::vector<double>& there, double power) {
    constexpr std::size_t sample = 2000;
    const input::Json& r = s.recipe;
    std::vector<double> out;
    const auto graded = r.find("grading");
    if (graded != r.end() && graded->is_array() && graded->size() > 1) {
        out = graded_radii(sample, points_of(*graded), 0);
    } else if (const auto beds = r.find("particles");
               beds != r.end() && beds->contains("grading") && input::text_at(*beds, "size") == "graded") {
        out = graded_radii(sample, points_of((*beds)["grading"]), 0);
    } else if (r.contains("radius_deviation") && r["radius_deviation"].is_number() && r["radius_deviation"] > 0.0) {
        out = normal_radii(sample, r["radius_deviation"], r["smallest_radius"], r["largest_radius"], 0);
    }
    const auto mean = [&](const std::vector<double>& d) {
        double sum = 0.0;
        for (const double x : d) {
            sum += std::pow(x, power) / static_cast<double>(d.size());
        }
        return sum;
    };
    const double scale = out.empty() ? 1.0 : std::pow(mean(there) / mean(out), 1.0 / power);
    for (double& d : out) {
        d *= scale;
    }
    return out;
}

} // namespace

report::Plot grading_plot(const Specimen& s) {
    const double power = s.shape.planar() ? 2.0 : 3.0;
    const auto there = diameters_of(s);
    report::Plot plot{"Grading: share of the mass that is finer.", "diameter [mm]", "passing [%]", {}, {}};
    plot.x_from_zero = false;
    if (there.empty()) {
        return plot;
    }
    if (auto asked = wanted(s, there, power); !asked.empty()) {
        plot.curves.push_back(sieve_line("asked for", std::move(asked), power));
        plot.curves.back().colour = "#c0392b";
        plot.curves.back().style = report::CurveStyle::dashed;
        plot.curves.back().width = 2.4;
    }
    plot.curves.push_back(sieve_line("in the specimen", there, power));
    return plot;
}

report::Plot coordination_plot(const Model& m) {
    std::vector<std::size_t> bonds(m.spheres.size(), 0);
    for (std::size_t b = 0; b < m.bonds.size(); ++b) {
        ++bonds[static_cast<std::size_t>(m.bonds.i[b])];
        ++bonds[static_cast<std::size_t>(m.bonds.j[b])];
    }
    report::Plot plot{"Coordination: spheres by the number of their bonds.", "bonds of a sphere", "spheres [%]", {}, {}};
    report::Curve bars{"", {}, {}, "#1f4e79", report::CurveStyle::bars};
    const std::size_t most = bonds.empty() ? 0 : *std::max_element(bonds.begin(), bonds.end());
    for (std::size_t n = 0; n <= most; ++n) {
        bars.x.push_back(static_cast<double>(n));
        const auto with = static_cast<double>(std::count(bonds.begin(), bonds.end(), n));
        bars.y.push_back(100.0 * with / static_cast<double>(std::max<std::size_t>(1, bonds.size())));
    }
    plot.curves = {std::move(bars)};
    return plot;
}

report::Rose fabric_rose(const Model& m) {
    constexpr std::size_t sectors = 9;
    report::Rose rose;
    rose.title = "Fabric: directions of the bonds.";
    rose.about = "Angle to the axis z, by number. An isotropic specimen fills the outline.";
    rose.parts = {{"bonds", "#1f4e79", std::vector<double>(sectors, 0.0)}};
    rose.even_name = "isotropic";
    for (const auto& facet : crack_facets(m)) {
        const double angle = degrees * std::acos(std::min(1.0, std::fabs(facet.normal.z())));
        rose.parts[0].weight[std::min(sectors - 1, static_cast<std::size_t>(angle / 90.0 * sectors))] += 1.0;
    }
    for (std::size_t k = 0; k < sectors; ++k) {
        const auto edge = [&](std::size_t n) { return std::cos(static_cast<double>(n) * 0.5 * std::numbers::pi / sectors); };
        rose.even.push_back(m.spheres.planar ? 1.0 : edge(k) - edge(k + 1)); // of a sphere's surface between two latitudes
    }
    return rose;
}

report::Section specimen_section(const Bench& bench) {
    const auto& s = bench.statistics;
    report::Section out{"Specimen", fmt::format("Porosity {:.2f} %.", 100.0 * s.porosity), {grading_plot(bench.specimen)}};
    if (bench.model->bonds.size() > 0) {
        out.about += fmt::format(" {:.2f} bonds a sphere in the mean. Fabric deviator of touching spheres {:.4f} (0: isotropic).",
                                 bench.coordination, s.fabric_deviator);
        out.plots.push_back(coordination_plot(*bench.model));
        out.roses = {fabric_rose(*bench.model)};
    }
    return out;
}

} // namespace proveta
