#include "lab/instruments.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/linear_field.hpp"
#include "lab/fragments.hpp"
#include "lab/membrane.hpp"

namespace proveta {

Instruments::Instruments(const Bench& bench) : gauges_(bench.specimen.shape, bench.model->spheres) {
    const Shape& shape = bench.specimen.shape;
    const Spheres& s = bench.model->spheres;
    height_ = shape.height;
    off_ = detached_spheres(*bench.model);
    area_now_ = bench.press.area_now;
    if (!bench.model->walls.bodies.empty()) {
        volume_ = enclosed_volume(bench.model->walls.bodies.front());
        girth_radius_ = middle_radius(bench.model->walls.bodies.front());
    }
    inner_ = bench.press.inner;
    middle_ = bench.press.bands ? shape.inner(1.0, 0.6) : inner_;
    for (std::size_t k = 0; k < s.size(); ++k) {
        if (inner_.contains(s.start.at(k))) {
            inside_.push_back(k);
        }
    }
}

double Instruments::area(const Model& m, const Press& press) {
    if (!press.area_now) {
        return press.area;
    }
    return enclosed_volume(m.walls.bodies.front()) / (m.walls.platens[1].position - m.walls.platens[0].position);
}

void Instruments::visit_state(const std::string& prefix, StateVisitor& visit) {
    visit(prefix + "off", off_); // as of the last sample, which the bonds now do not tell
    visit(prefix + "off_at", off_at_);
    visit(prefix + "broken_in_tension", broken_tension_);
    visit(prefix + "broken_in_shear", broken_shear_);
}

double Instruments::girth_strain(const Model& m) const { return gauges_.girth_strain(m.spheres.position, off_); }

// Least squares of u = a + G x over the spheres of the region.
Mat3 Instruments::mean_strain(const Model& m) const {
    if (inside_.size() < 4) {
        return Mat3::Zero();
    }
    LinearField field;
    for (const auto k : inside_) {
        if (off_[k] == 0) {
            const Vec3 p = m.spheres.start.at(k);
            field.add(p - Vec3(0.0, 0.0, 0.5 * height_), m.spheres.position.at(k) - p);
        }
    }
    const Mat3 slopes = field.slopes(m.spheres.planar);
    return -0.5 * (slopes + slopes.transpose());
}

namespace {

// Of the body that a sphere is, or belongs to: a branch of the stress goes from body to body.
Vec3 centre_of_body(const Model& m, std::size_t sphere) {
    const auto body = m.clusters.of(sphere);
    return body < 0 ? m.spheres.position.at(sphere) : m.clusters.position[static_cast<std::size_t>(body)];
}

} // namespace

Mat3 Instruments::mean_stress(const Model& model, const Shape::Region& region) const {
    Mat3 sum = Mat3::Zero();
    const Bonds& b = model.bonds;
    const auto add = [&](std::size_t i, std::size_t j, const Vec3& force) {
        if (off_[i] != 0 || off_[j] != 0) {
            return;
        }
        const Vec3 at_i = centre_of_body(model, i);
        const Vec3 at_j = centre_of_body(model, j);
        const double inside = region.fraction_inside(at_i, at_j);
        if (inside > 0.0) {
            sum -= inside * force * (at_j - at_i).transpose(); // force on i: compression pushes it against the branch
        }
    };
    for (std::size_t k = 0; k < b.size(); ++k) {
        add(static_cast<std::size_t>(b.i[k]), static_cast<std::size_t>(b.j[k]), b.force.at(k));
    }
    const Contacts& c = model.contacts;
    for (std::size_t k = 0; k < c.size(); ++k) {
        add(static_cast<std::size_t>(c.i[k]), static_cast<std::size_t>(c.j[k]), c.force.at(k));
    }
    const Mat3 mean = sum / region.volume();
    return 0.5 * (mean + mean.transpose());
}

std::vector<report::Column> Instruments::curve_columns(bool area_now) {
    return {
        {"time", "s", "time since the start of loading"},
        {"stage", "", "number of the stage, from 0"},
        {"phase", "", "0 preparing the loading, 1 loading, 2 unloading or reloading"},
        {"axial_strain", "", "closing of the platens over their distance at the start"},
        {"axial_stress", "Pa", "total axial stress: mean of both platens' force over the nominal area"},
        {"deviatoric_stress", "Pa", "axial minus lateral stress"},
        {"lateral_stress", "Pa", "mean of the forces that the side feels, from a ring, a membrane or a pressure, over its area"},
        {"cell_pressure", "Pa", "that the test commands on the side; not a measurement"},
        {"gauge_axial_strain", "", "shortening of the middle gauge length along the loading"},
        {"circumferential_strain", "", "shortening of the girth at mid-height, from the lateral skin, or of the gauge across the loading"},
        {"volumetric_strain", "",
         area_now ? "loss of the volume inside the membrane over that at the start"
                  : "gauge axial strain plus twice the circumferential strain (of a plate: plus once)"},
        {"force_bottom", "N", "force on the first (lower) platen"},
        {"force_top", "N", "force on the second (upper) platen"},
        {"inner_strain_xx", "", "mean strain of the inner region, from the displacements of its spheres"},
        {"inner_strain_yy", "", "the same"},
        {"inner_strain_zz", "", "the same"},
        {"inner_stress_xx", "Pa", "Love-Weber stress averaged over the inner region"},
        {"inner_stress_yy", "Pa", "the same"},
        {"inner_stress_zz", "Pa", "the same"},
        {"inner_stress_xy", "Pa", "the same"},
        {"inner_stress_yz", "Pa", "the same"},
        {"inner_stress_zx", "Pa", "the same"},
        {"middle_stress", "Pa",
         "Love-Weber stress along the loading over the whole section, middle 60 % of the height; of a disc the inner region's"},
        {"broken_bonds", "", "failed bonds so far"},
        {"broken_in_tension", "", "of these in tension"},
        {"broken_in_shear", "", "of these in shear"},
        {"unbalanced_ratio", "", "sum over spheres of the unbalanced force over the sum of bond forces"},
        {"rate", "m/s", "closing speed of the platens, negative when they part"}};
}

report::Table Instruments::empty_curve() const {
    report::Table t;
    t.notes = {"Compression is positive in stress and strain; lateral strain is positive when the specimen gets thinner.",
               area_now_ ? "Stress is force over the mean section at the time: volume inside the membrane over the height."
                         : "Stress is force over the nominal area before the test."};
    t.columns = curve_columns(area_now_);
    if (volume_ > 0.0) {
        t.columns.push_back({"membrane_volumetric_strain", "", "loss of the volume inside the membrane over that at the start"});
        t.columns.push_back(
            {"membrane_girth_strain", "", "shortening of the membrane's girth at mid-height, positive when it gets thinner"});
        t.columns.push_back(
            {"membrane_force", "N", "that the membrane itself bears along the axis, compression positive; not in axial_stress"});
        t.columns.push_back({"membrane_crossings", "", "contacts so far whose sphere's centre lay beyond the membrane: 0 unless it leaks"});
    }
    return t;
}

report::Table Instruments::empty_energy() {
    report::Table t;
    t.notes = {"Energy ledger: every term is accumulated from its own mechanism, none by difference."};
    t.columns = {{"time", "s", "time since the start of loading"},
                 {"axial_strain", "", "closing of the platens over their distance at the start"},
                 {"platens", "J", "work of the platens on the specimen"},
                 {"pressure", "J", "work of the pressure on its side"},
                 {"gravity", "J", "work of gravity"},
                 {"initial", "J", "kinetic and stored energy at the start"},
                 {"coupling", "J", "made, or taken out where negative, by sharing contact forces out over a membrane"},
                 {"elastic", "J", "stored in bonds, contacts and membrane"},
                 {"kinetic", "J", "of translation and rotation"},
                 {"damage", "J", "dissipated by damage and failure of bonds"},
                 {"plastic", "J", "dissipated by plastic shortening of bonds"},
                 {"friction", "J", "dissipated by sliding"},
                 {"dashpots", "J", "dissipated by local damping"},
                 {"background", "J", "dissipated by background damping"},
                 {"residual", "J", "the first five terms minus all others"}};
    return t;
}

double Instruments::lateral_stress(const Model& m, const Press& press) {
    if (press.side_area > 0.0) {
        double held = 0.0;
        for (std::size_t p = 2; p < m.walls.platens.size(); ++p) {
            held += m.walls.platens[p].thrust;
        }
        return held / press.side_area;
    }
    if (!m.walls.bodies.empty()) {
        return pressure_inside(m.walls.bodies.front());
    }
    return m.pressures.empty() ? 0.0 : side_stress(m.spheres, m.pressures.front());
}

void Instruments::sample(const Bench& bench, const Mark& mark, report::Table& curve, report::Table& energy) {
    const Model& m = *bench.model;
    const Press& press = bench.press;
    if (const auto broken = static_cast<std::int64_t>(m.broken()); broken != off_at_) {
        off_ = detached_spheres(m);
        off_at_ = broken;
    }
    const double bottom = m.walls.platens[0].load();
    const double top = m.walls.platens[1].load();
    const double strain = 1.0 - (m.walls.platens[1].position - m.walls.platens[0].position) / press.length;
    const Mat3 stretched = mean_strain(m);
    const Vec3 along = m.walls.platens[0].face.axis;
    const Vec3 across = Vec3::UnitZ().cross(along);
    const double gauge = press.bands ? gauges_.axial_strain(m.spheres.position, off_) : along.dot(stretched * along);
    const double girth = press.bands ? girth_strain(m) : across.dot(stretched * across);
    const bool wrapped = !m.walls.bodies.empty();
    const double squeezed = wrapped ? 1.0 - enclosed_volume(m.walls.bodies.front()) / volume_ : 0.0;
    const double volume = press.area_now ? squeezed : press.bands ? gauge + (m.spheres.planar ? 1.0 : 2.0) * girth : stretched.trace();
    const double lateral = lateral_stress(m, press);
    const Mat3 inner = mean_stress(m, inner_);
    const double stress = 0.5 * (bottom + top) / area(m, press);
    curve.rows.push_back({m.time(),
                          mark.stage,
                          mark.phase,
                          strain,
                          stress,
                          stress - lateral,
                          lateral,
                          mark.pressure,
                          gauge,
                          girth,
                          volume,
                          bottom,
                          top,
                          stretched(0, 0),
                          stretched(1, 1),
                          stretched(2, 2),
                          inner(0, 0),
                          inner(1, 1),
                          inner(2, 2),
                          inner(0, 1),
                          inner(1, 2),
                          inner(2, 0),
                          along.dot(mean_stress(m, middle_) * along),
                          static_cast<double>(broken_tension_ + broken_shear_),
                          static_cast<double>(broken_tension_),
                          static_cast<double>(broken_shear_),
                          m.measures().unbalanced_ratio,
                          m.walls.platens[0].velocity - m.walls.platens[1].velocity});
    if (wrapped) {
        const Deformable& membrane = m.walls.bodies.front();
        for (const double value :
             {squeezed, 1.0 - middle_radius(membrane) / girth_radius_, axial_force(membrane), static_cast<double>(membrane.crossings)}) {
            curve.rows.back().push_back(value);
        }
    }
    const Ledger& l = m.ledger();
    energy.rows.push_back({m.time(), strain, l.platens, l.pressure, l.body, l.initial, l.coupling, l.elastic, l.kinetic, l.damage,
                           l.plastic, l.friction, l.dashpots, l.background, l.residual()});
}

} // namespace proveta
