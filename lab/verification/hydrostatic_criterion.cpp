// Failure criteria under pure confinement (thesis 5.4.5, fig. 5.26).
#include <algorithm>
#include <cmath>

#include "core/averaged_stress.hpp"
#include "lab/bench.hpp"
#include "lab/controls/closing.hpp"
#include "lab/surface_pressure.hpp"
#include "lab/verification/cases.hpp"

namespace proveta::verification {

namespace hydrostatic_criterion_case {

struct Confined {
    std::vector<double> inside; // criterion values of the bonds in the inner 60 %, ascending
    double stress = 0.0;        // mean pressure there, Pa
    double deviator = 0.0;      // mean over spheres of von Mises' stress over the pressure
    std::size_t broken = 0;
};

Confined confine(const std::string& criterion, double pressure) {
    const input::Json json = {{"test", "ucs"},
                              {"specimen", {{"spheres", 3000}}},
                              {"material", {{"card", "thesis"}, {"local_damping", 0.0}, {"criterion", criterion}}}};
    const Deck deck = read_deck(json, "hydrostatic");
    Bench bench = set_up(deck, make_specimen(deck.specimen));
    const Shape& shape = bench.specimen.shape;
    Numerics numerics;
    Model model(bench.model->spheres, bench.model->materials, bench.model->bonds, std::vector<double>(bench.model->spheres.size(), 1.0), {},
                numerics);
    model.pressures = {lateral_pressure(shape, model.spheres, model.bonds), end_pressure(shape, model.spheres, model.bonds, 1.0),
                       end_pressure(shape, model.spheres, model.bonds, -1.0)};
    const double ramp = 15.0 * shape.height / bench.wave_speed;
    while (model.time() < 1.4 * ramp) {
        for (auto& p : model.pressures) {
            p.value = pressure * smooth_start(model.time(), ramp);
        }
        model.step({}, false);
    }
    model.step({}, true);
    const Shape::Region inner = shape.inner(0.6, 0.6);
    Confined out;
    for (std::size_t b = 0; b < model.bonds.size(); ++b) {
        const Vec3 i = model.spheres.start.at(static_cast<std::size_t>(model.bonds.i[b]));
        const Vec3 j = model.spheres.start.at(static_cast<std::size_t>(model.bonds.j[b]));
        if (inner.fraction_inside(i, j) == 1.0) {
            out.inside.push_back(model.bonds.criterion[b]);
        }
    }
    std::sort(out.inside.begin(), out.inside.end());
    const auto stress = sphere_stresses(model.spheres, model.bonds, model.contacts, model.walls, model.pressures,
                                        tributary_volumes(model.spheres, model.bonds));
    double count = 0.0;
    for (std::size_t k = 0; k < stress.size(); ++k) {
        if (inner.contains(model.spheres.start.at(k))) {
            out.stress += stress[k].trace() / 3.0;
            const Mat3 deviator = stress[k] - Mat3::Identity() * (stress[k].trace() / 3.0);
            out.deviator += std::sqrt(1.5) * deviator.norm() / pressure;
            count += 1.0;
        }
    }
    out.stress /= count;
    out.deviator /= count;
    out.broken = model.broken();
    return out;
}

report::Curve distribution(const Confined& c, const char* name, const char* colour) {
    report::Curve curve{name, {}, {}, colour};
    for (std::size_t k = 0; k < c.inside.size(); k += std::max<std::size_t>(1, c.inside.size() / 200)) {
        curve.x.push_back(c.inside[k]);
        curve.y.push_back(100.0 * static_cast<double>(k + 1) / static_cast<double>(c.inside.size()));
    }
    curve.x.push_back(c.inside.back());
    curve.y.push_back(100.0);
    return curve;
}

} // namespace hydrostatic_criterion_case

Case hydrostatic_criterion() {
    using namespace hydrostatic_criterion_case;
    return {"hydrostatic-criterion", "5.4.5",
            "A cylinder under 30 MPa all round: use of strength by each bond's own direction and by averaged stress.", false, [] {
                constexpr double p = 30e6;
                const Confined bond = confine("bond", p);
                const Confined averaged = confine("mohr_coulomb", p);
                Outcome out;
                // Love-Weber over the inner spheres: the partition of space by bond areas is good to 3.5 % inside.
                out.checks.push_back({"mean pressure inside", p, bond.stress, 0.04, Compare::relative, "Pa"});
                out.checks.push_back(
                    {"largest criterion inside, each bond by itself", 0.2, bond.inside.back(), 0.0, Compare::at_least, "", "about 0.3"});
                out.checks.push_back(
                    {"largest criterion inside, averaged Mohr-Coulomb", 0.1, averaged.inside.back(), 0.0, Compare::at_most, ""});
                out.checks.push_back(
                    {"median criterion, each bond by itself", 0, bond.inside[bond.inside.size() / 2], 0, Compare::reported, ""});
                out.checks.push_back(
                    {"median criterion, averaged Mohr-Coulomb", 0, averaged.inside[averaged.inside.size() / 2], 0, Compare::reported, ""});
                out.checks.push_back({"mean of von Mises' stress over the pressure, a sphere", 0, bond.deviator, 0, Compare::reported, ""});
                out.checks.push_back(
                    {"bonds failed, averaged Mohr-Coulomb", 0, static_cast<double>(averaged.broken), 0, Compare::absolute, ""});
                out.plots.push_back(
                    {"Use of strength in a cylinder under 30 MPa all round (inner bonds).",
                     "failure criterion state",
                     "share of bonds below [%]",
                     {distribution(bond, "each bond by itself", "#c0392b"), distribution(averaged, "averaged Mohr-Coulomb", "#1f4e79")},
                     {}});
                return out;
            }};
}

} // namespace proveta::verification
