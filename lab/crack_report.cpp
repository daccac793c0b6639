#include "lab/crack_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/angles.hpp"
#include "lab/fragments.hpp"

namespace proveta {

namespace {

constexpr const char* tension_colour = "#c0392b";
constexpr const char* shear_colour = "#d68910";

// A rose with all facets as its outline; angle_of: degrees from 0 to turn; weight_of: of a facet, m2.
template <class Angle, class Weight>
report::Rose rose_of(const std::vector<CrackFacet>& facets, double turn, std::size_t sectors, const Angle& angle_of,
                     const Weight& weight_of) {
    report::Rose rose;
    rose.turn = turn;
    rose.parts = {{"failed in tension", tension_colour, std::vector<double>(sectors, 0.0)},
                  {"failed in shear", shear_colour, std::vector<double>(sectors, 0.0)}};
    rose.even.assign(sectors, 0.0);
    rose.even_name = "all bonds before the test";
    for (const auto& f : facets) {
        const auto k = std::min(sectors - 1, static_cast<std::size_t>(angle_of(f) / turn * static_cast<double>(sectors)));
        rose.even[k] += weight_of(f);
        if (f.mode != FailureMode::intact) {
            rose.parts[f.mode == FailureMode::tension ? 0 : 1].weight[k] += weight_of(f);
        }
    }
    return rose;
}

// Mass without what mass scaling adds, kg.
double true_mass(const Model& m, std::size_t k) {
    return m.spheres.volume(k) * m.materials[static_cast<std::size_t>(m.spheres.material[k])].density;
}

} // namespace

std::vector<CrackFacet> crack_facets(const Model& m) {
    std::vector<CrackFacet> out;
    out.reserve(m.bonds.size());
    for (std::size_t b = 0; b < m.bonds.size(); ++b) {
        const Vec3 to =
            m.spheres.start.at(static_cast<std::size_t>(m.bonds.j[b])) - m.spheres.start.at(static_cast<std::size_t>(m.bonds.i[b]));
        out.push_back({to.normalized(), m.bonds.area[b], static_cast<FailureMode>(m.bonds.mode[b])});
    }
    return out;
}

report::Plot failure_histogram(const std::vector<FailureEvent>& events, double scale) {
    constexpr std::size_t bins = 24;
    report::Plot plot{"Failures of bonds by the strain at which they came.", "axial strain [%]", "failed bonds in an interval", {}, {}};
    plot.curves = {{"in tension", {}, {}, tension_colour, report::CurveStyle::bars},
                   {"in shear", {}, {}, shear_colour, report::CurveStyle::bars}};
    double low = 0.0;
    double high = 0.0;
    for (const auto& e : events) {
        low = std::min(low, scale * e.axial_strain);
        high = std::max(high, scale * e.axial_strain);
    }
    const double wide = (high - low) / bins;
    for (auto& curve : plot.curves) {
        for (std::size_t k = 0; k < bins && wide > 0.0; ++k) {
            curve.x.push_back(low + (static_cast<double>(k) + 0.5) * wide);
            curve.y.push_back(0.0);
        }
    }
    for (const auto& e : events) {
        if (wide > 0.0) {
            const auto k = std::min(bins - 1, static_cast<std::size_t>((scale * e.axial_strain - low) / wide));
            plot.curves[e.mode == FailureMode::tension ? 0 : 1].y[k] += 1.0;
        }
    }
    return plot;
}

report::Rose crack_dips(const std::vector<CrackFacet>& facets, const Vec3& axis) {
    const auto angle = [&](const CrackFacet& f) { return degrees * std::asin(std::min(1.0, std::fabs(f.normal.dot(axis)))); };
    report::Rose rose = rose_of(facets, 90.0, 9, angle, [](const CrackFacet& f) { return f.area; });
    rose.title = "Cracks against the loading axis.";
    rose.about = "0 degrees: along the axis, as splitting; 90: across it. A sector's area is its share of the cracked area.";
    return rose;
}

report::Rose crack_strikes(const std::vector<CrackFacet>& facets, const Vec3& axis, const Vec3& across) {
    const Vec3 third = axis.cross(across);
    const auto angle = [&](const CrackFacet& f) { // the crack runs at a right angle to its normal
        const double strike = degrees * std::atan2(f.normal.dot(third), f.normal.dot(across)) + 90.0;
        return std::fmod(strike + 360.0, 180.0);
    };
    const auto weight = [&](const CrackFacet& f) { return f.area * std::sqrt(std::max(0.0, 1.0 - std::pow(f.normal.dot(axis), 2))); };
    report::Rose rose = rose_of(facets, 180.0, 12, angle, weight);
    rose.title = "Cracks around the loading axis.";
    rose.about =
        "The direction in which cracks run, seen along the axis, by their area upright to that view; opposite sectors are the same.";
    return rose;
}

report::TextTable fragment_table(const Model& m) {
    constexpr std::size_t most = 5;
    struct Piece {
        std::size_t spheres = 0;
        double mass = 0.0;
    };
    std::vector<Piece> pieces;
    double total = 0.0;
    const auto number = fragments(m);
    for (std::size_t k = 0; k < number.size(); ++k) {
        const auto f = static_cast<std::size_t>(number[k]);
        pieces.resize(std::max(pieces.size(), f + 1));
        ++pieces[f].spheres;
        pieces[f].mass += true_mass(m, k);
        total += true_mass(m, k);
    }
    std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.mass > b.mass; });
    report::TextTable t{"Fragments at the end: what bonds still hold together",
                        {{"Fragment", "Number", "Spheres", "Mass [kg]", "Share of the mass [%]"}}};
    const auto add = [&](const std::string& name, std::size_t n, const Piece& sum) {
        t.rows.push_back({name, std::to_string(n), std::to_string(sum.spheres), report::three_digits(sum.mass),
                          fmt::format("{:.3g}", 100.0 * sum.mass / total)});
    };
    std::size_t n_rest = 0;
    std::size_t n_single = 0;
    Piece rest;
    Piece single;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        const Piece& p = pieces[k];
        if (p.spheres == 1) {
            ++n_single;
            single = {single.spheres + 1, single.mass + p.mass};
        } else if (k < most) {
            add(k == 0 ? "The largest" : fmt::format("Number {}", k + 1), 1, p);
        } else {
            ++n_rest;
            rest = {rest.spheres + p.spheres, rest.mass + p.mass};
        }
    }
    if (n_rest > 0) {
        add("Smaller ones", n_rest, rest);
    }
    if (n_single > 0) {
        add("Single spheres", n_single, single);
    }
    if (total > 0.0) {
        add("All", pieces.size(), {m.spheres.size(), total});
    }
    return t;
}

report::Section crack_section(const Bench& bench, const std::vector<FailureEvent>& events) {
    const Model& m = *bench.model;
    const Vec3 axis = bench.press.bands ? Vec3::UnitZ() : Vec3::UnitX(); // of a disc on its side the load runs along x
    const Vec3 across = bench.press.bands ? Vec3::UnitX() : Vec3::UnitY();
    report::Section s{"Cracks and fragments", ""};
    if (events.empty()) {
        s.about = "No bond failed.";
        return s;
    }
    const auto facets = crack_facets(m);
    double area = 0.0;
    double tension = 0.0;
    for (const auto& f : facets) {
        area += f.mode == FailureMode::intact ? 0.0 : f.area;
        tension += f.mode == FailureMode::tension ? f.area : 0.0;
    }
    const auto failed = std::count_if(facets.begin(), facets.end(), [](const auto& f) { return f.mode != FailureMode::intact; });
    s.about = fmt::format(
        "{} of {} bonds failed, with {} cm\u00b2 of crack area, of which {:.3g} % in tension. Directions are those of the bonds "
        "before the test; a crack lies across its bond.",
        failed, facets.size(), report::three_digits(1e4 * area), area > 0.0 ? 100.0 * tension / area : 0.0);
    s.plots = {failure_histogram(events, 100.0 * bench.press.sense)};
    s.roses = {crack_dips(facets, axis)};
    if (!m.spheres.planar) {
        s.roses.push_back(crack_strikes(facets, axis, across));
    }
    s.tables = {fragment_table(m)};
    return s;
}

} // namespace proveta
