// A sphere on the middle of a simply supported beam against Timoshenko's solution (thesis 4.5.1, fig. 4.14).
#include <algorithm>
#include <numbers>

#include "lab/verification/cases.hpp"
#include "lab/verification/struck_beam.hpp"

namespace proveta::verification {

namespace beam_impact_case {

constexpr int modes = 50;        // odd ones: twice as many change nothing in four digits
constexpr double instant = 5e-8; // s, of the modal solution: to which contact times are known

struct Beam {
    std::string name;
    StruckBeam beam;
    int elements;
    double until; // s: the sphere is gone then, and is not caught up with (looked at until 8 ms)
    double impacts;
    const char* figure;
};

report::Curve curve(const std::string& name, const std::vector<double>& t, const std::vector<double>& y, double factor, const char* colour,
                    report::CurveStyle style) {
    report::Curve out{name, {}, {}, colour, style};
    const std::size_t every = std::max<std::size_t>(1, t.size() / 1500);
    for (std::size_t k = 0; k < t.size(); k += every) {
        out.x.push_back(1e3 * t[k]);
        out.y.push_back(factor * y[k]);
    }
    return out;
}

void compare(const Beam& which, Outcome& out) {
    const ImpactHistory slender = modal_solution(which.beam, BeamTheory::slender, modes, instant, which.until);
    const ImpactHistory thick = modal_solution(which.beam, BeamTheory::thick, modes, instant, which.until);
    Model model = struck_beam_model(which.beam, which.elements, 3, 4, Coupling::area_distributed);
    const ImpactHistory found = run_impact(which.beam, model, which.until);
    const std::string of = ", " + which.name;
    const auto row = [&](const std::string& quantity, double tolerance, const char* unit, auto&& of_history) {
        out.checks.push_back({quantity + of, of_history(slender), of_history(found), tolerance, Compare::relative, unit, ""});
        out.checks.push_back(
            {quantity + " of a beam that shears" + of, of_history(slender), of_history(thick), 0.0, Compare::reported, unit, ""});
    };
    row("peak force", 0.02, "N", [](const ImpactHistory& h) { return h.peak(); });
    row("first contact time", 0.02, "s", [](const ImpactHistory& h) { return h.contact_time(); });
    row("first impulse", 0.01, "N s", [](const ImpactHistory& h) { return h.impulse(); });
    row("largest deflection", 0.03, "m", [](const ImpactHistory& h) { return h.deepest(); });
    const auto contacts = found.contacts();
    out.checks.push_back({"impacts" + of, which.impacts, static_cast<double>(contacts.size()), 0.0, Compare::absolute, "", ""});
    out.checks.push_back({"impacts of the modal solution" + of, which.impacts, static_cast<double>(slender.contacts().size()), 0.0,
                          Compare::absolute, "", ""});
    for (std::size_t k = 1; k < std::min(contacts.size(), slender.contacts().size()); ++k) {
        out.checks.push_back({"begin of impact " + std::to_string(k + 1) + of, slender.contacts()[k].first, contacts[k].first, 0.03,
                              Compare::relative, "s", "\"a deviation\""});
    }
    out.checks.push_back(
        {"energy lost or made, over the sphere's" + of, 0.0, model.ledger().relative_residual(), 1e-5, Compare::absolute, "", ""});
    const std::string title = which.name + " beam (" + which.figure + ")";
    out.plots.push_back({"Contact force, " + title,
                         "time [ms]",
                         "force [N]",
                         {curve("modal solution", slender.time, slender.force, 1.0, "#111111", report::CurveStyle::solid),
                          curve("elements", found.time, found.force, 1.0, "#c0392b", report::CurveStyle::dashed)},
                         {}});
    out.plots.push_back({"Deflection in the middle, " + title,
                         "time [ms]",
                         "deflection [um]",
                         {curve("modal solution", slender.time, slender.deflection, 1e6, "#111111", report::CurveStyle::solid),
                          curve("elements", found.time, found.deflection, 1e6, "#c0392b", report::CurveStyle::dashed)},
                         {}});
}

// The first mode's frequency over that of the slender beam: elements of length a stiffen a beam of height h by a shear that bending does
// not have, a^2 / (2 (1 + nu) h^2), and by what their straight sides keep of the Poisson strain, about nu^2 / n^2 of n layers.
std::string note(const StruckBeam& beam, int elements, int layers) {
    const double a = beam.length / elements;
    const double stiffer = a * a / (2.0 * (1.0 + beam.poisson) * beam.side * beam.side) + beam.poisson * beam.poisson / (layers * layers);
    return "Bending is stiffer by " + std::to_string(100.0 * stiffer).substr(0, 4) +
           " % than in a slender beam in elements of this size, which raises frequencies by half of that; shear and rotatory inertia lower "
           "them by 0.7 % (short beam, first mode), 6 % (third) and more. The tolerances bear both. The rows \"of a beam that shears\" "
           "show "
           "the modal solution of Timoshenko's thick beam.";
}

Outcome compute() {
    StruckBeam second;
    second.radius = 0.02;
    second.length = 0.307;
    Outcome out;
    out.checks = {{"period of the first mode, short, literal", 0.998e-3, 2.0 * std::numbers::pi / StruckBeam{}.frequency(1), 5e-4,
                   Compare::relative, "s", ""}}; // three digits
    compare({"short", {}, 60, 1.5e-3, 1.0, "fig. 4.14a"}, out);
    compare({"long", second, 120, 3.6e-3, 3.0, "fig. 4.14b"}, out);
    out.notes = {note({}, 60, 4),
                 "The ends are held across the beam as a whole, which is Navier's support: sections turn freely. The step is the "
                 "program's own, 0.3 us, against 0.01 us in the thesis."};
    return out;
}

} // namespace beam_impact_case

Case beam_impact() {
    using namespace beam_impact_case;
    return {"beam-impact", "4.5.1", "A steel sphere falls on the middle of a simply supported beam, against the solution by modes.", false,
            compute};
}

} // namespace proveta::verification
