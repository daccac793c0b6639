#include "lab/test_plots.hpp"

#include <algorithm>
#include <cmath>

#include "lab/derived.hpp"

namespace proveta {

namespace {

// The curve, or the energies if the curve has no column of this name.
const report::Table& table_with(const TestData& data, const std::string& name) {
    const auto& columns = data.curve.columns;
    return std::any_of(columns.begin(), columns.end(), [&](const auto& c) { return c.name == name; }) ? data.curve : data.energy;
}

std::vector<double> column_of(const TestData& data, const std::string& name, double scale) {
    auto values = table_with(data, name).values(name);
    for (double& v : values) {
        v *= scale;
    }
    return values;
}

report::Plot plot_of(const PlotSpec& spec, const TestData& data) {
    report::Plot p{spec.title, spec.x_title, spec.y_title, {}, {}};
    for (const auto& c : spec.curves) {
        report::Curve curve{c.name, column_of(data, c.x, spec.x_scale), column_of(data, c.y, spec.y_scale), c.colour};
        const std::size_t peak = peak_index(curve.y);
        if (c.to_peak) {
            curve.x.resize(std::min(curve.x.size(), peak + 1));
            curve.y.resize(curve.x.size());
        }
        if (spec.mark_peak && p.curves.empty() && !curve.y.empty()) {
            p.marks.emplace_back(curve.x[peak], curve.y[peak]);
        }
        p.curves.push_back(std::move(curve));
    }
    return p;
}

} // namespace

std::vector<report::Plot> test_plots(const Protocol& protocol, double sense, bool bonded, const TestData& data) {
    auto specs = protocol.plots();
    if (bonded) {
        specs.push_back(
            {"Failed bonds.",
             "axial strain [%]",
             "failed bonds",
             sense * 100.0,
             1.0,
             {{"axial_strain", "broken_in_tension", "in tension", "#c0392b"}, {"axial_strain", "broken_in_shear", "in shear", "#d68910"}}});
    }
    specs.push_back({"Where the work put in went.",
                     "axial strain [%]",
                     "energy [J]",
                     sense * 100.0,
                     1.0,
                     {{"axial_strain", "platens", "work of platens", "#111111"},
                      {"axial_strain", "elastic", "elastic", "#1f4e79"},
                      {"axial_strain", "damage", "damage", "#c0392b"},
                      {"axial_strain", "plastic", "plastic", "#7d3c98"},
                      {"axial_strain", "friction", "friction", "#b9770e"},
                      {"axial_strain", "background", "background damping", "#1e7b46"},
                      {"axial_strain", "kinetic", "kinetic", "#0e8a93"}}});
    if (!data.energy.rows.empty() && data.energy.rows.back()[data.energy.column("pressure")] != 0.0) {
        specs.back().curves.insert(specs.back().curves.begin() + 1, {"axial_strain", "pressure", "work of the pressure", "#7f8c8d"});
    }
    std::vector<report::Plot> out;
    for (const auto& spec : specs) {
        out.push_back(plot_of(spec, data));
    }
    return out;
}

MainCurve main_curve(const Protocol& protocol, const TestData& data) {
    const PlotSpec spec = protocol.plots().front();
    const PlotCurve& curve = spec.curves.front();
    const auto column = [&](const std::string& name) {
        const report::Table& table = table_with(data, name);
        return table.columns[table.column(name)];
    };
    return {{column_of(data, curve.x, std::copysign(1.0, spec.x_scale)), column_of(data, curve.y, std::copysign(1.0, spec.y_scale))},
            column(curve.x),
            column(curve.y),
            {spec.title, spec.x_title, spec.y_title, std::fabs(spec.x_scale), std::fabs(spec.y_scale)}};
}

} // namespace proveta
