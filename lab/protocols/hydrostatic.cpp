// Equal pressure on the whole surface.
#include <algorithm>
#include <cmath>

#include "lab/axial_results.hpp"
#include "lab/confinement.hpp"
#include "lab/controls/closing.hpp"
#include "lab/deck.hpp"
#include "lab/stages.hpp"
#include "lab/surface_pressure.hpp"

namespace proveta {

namespace {

constexpr double crush_offset = 0.0002;
constexpr double ramp_crossings = 150.0; // of a wave, in the elastic range; the clock slows down where the specimen yields

class Hydrostatic : public Protocol {
  public:
    // 1. The standard: what it mimics and where it cannot.
    [[nodiscard]] ProtocolInfo about() const override {
        return {"hydrostatic",
                "Hydrostatic compression",
                "A cylinder or prism is brought under an equal pressure on its whole surface: on the side by forces on the surface "
                "spheres, on the "
                "ends by platens that a servo holds at the same stress.",
                {{"no standard",
                  "pressure against volumetric strain, as in the isotropic stage of a triaxial cell; bulk modulus, crush pressure",
                  "the ends are pressed by smooth rigid platens, not by a fluid; no jacket"}}};
    }

    void declare_loading(input::Visitor& v) override {
        v.number("pressure", pressure_, input::Unit::pressure, {0.0, 1e10, true, false}, "to which the pressure is brought up");
        v.number_or_word("ramp", ramp_, {{"auto", "the time in which a wave crosses the specimen 150 times"}}, input::Unit::time,
                         input::above(0),
                         "time in which it is brought up, steadily after a smooth start; longer where the specimen yields");
        v.number("servo_speed_limit", speed_limit_, input::Unit::velocity, {0.0, 100.0, true, false},
                 "largest closing speed of the platens while they follow the pressure");
        v.number("unload_to", unload_to_, input::Unit::none, {0.0, 1.0, false, false},
                 "share of the pressure to which it is taken back at the end, in as much time; 1: the test ends under pressure");
        declare_friction(v, friction_);
        v.refused("confining_pressure", "the pressure is the same all round: \"pressure\"");
        v.refused("rate", "the pressure leads: see \"ramp\"");
        v.refused("strips", "loading strips belong to a brazilian test");
    }

    void check(const Deck& deck, input::Problems& problems) const override {
        check_sides(deck, problems);
        Confinement c;
        c.pressure = pressure_;
        c.ramp = ramp_;
        c.speed_limit = speed_limit_;
        input::Problems found;
        check_confinement(c, deck, found);
        for (auto& problem : found) {
            problem.path = "/loading/ramp";
            problems.push_back(problem);
        }
    }

    // 2. Stages and 3. controls: one ramp of pressure, the platens on a servo.
    [[nodiscard]] Press press(const InPress& body) const override {
        Press press = axial_press(body.spheres, body.shape, friction_value(friction_), 1.0);
        press.pressures = {lateral_pressure(body.shape, body.spheres, body.bonds)};
        return press;
    }

    [[nodiscard]] std::vector<Stage> stages(const BenchView& bench, double pace) const override {
        const double ramp = (ramp_.word.empty() ? ramp_.number : ramp_crossings * bench.crossing()) / pace;
        const double start = 0.1 * ramp;
        // Steady after a tenth of the time: the integral of a smooth start, so that the pressure itself starts without a kink.
        const auto pressure = [p = pressure_, ramp, start](double time) {
            const double steady = p / (ramp - 0.5 * start);
            if (time >= start) {
                return steady * (time - 0.5 * start);
            }
            const double x = time / start;
            return steady * start * 0.5 * (x - std::sin(pi * x) / pi);
        };
        auto settings = servo_settings(bench, speed_limit_);
        settings.calm_speed = 2.0 * pressure_ / ramp * settings.compliance * bench.press.length;
        const auto control = std::make_shared<StressServo>(pressure, settings);
        const bool back = unload_to_ < 1.0;
        std::vector<Stage> stages{
            {"loading", Stage::Kind::loading, back ? 0.6 : 1.0, control, [=](const BenchView&) { return control->clock() / ramp; }}};
        if (back) {
            const auto falling = [p = pressure_, left = unload_to_, ramp](double time) {
                return p * (1.0 - (1.0 - left) * smooth_start(time, ramp));
            };
            settings.calm_speed = 0.0; // unloading is elastic: nothing runs away
            const auto release = std::make_shared<StressServo>(falling, settings);
            stages.push_back({"unloading", Stage::Kind::cycling, 1.0, release, [=](const BenchView&) { return release->clock() / ramp; }});
        }
        return stages;
    }

    // 4. Measurements are the bench's; the ramp ends the test.
    [[nodiscard]] std::optional<std::string> stop(const BenchView&) const override { return std::nullopt; }

    // 5. Derived results.
    [[nodiscard]] std::vector<report::Scalar> results(const Measured& m) const override {
        const Loading l = loading_of(m.curve, m.press.sense);
        std::vector<double> pressure;
        std::vector<double> lateral;
        for (const auto row : l.row) {
            pressure.push_back((l.stress[pressure.size()] + 2.0 * m.curve.rows[row][m.curve.column("lateral_stress")]) / 3.0);
            lateral.push_back(m.curve.rows[row][m.curve.column("lateral_stress")]);
        }
        const Loading part = first_samples(l, elastic_samples(m, l));
        const std::vector<double> low(pressure.begin(), pressure.begin() + static_cast<std::ptrdiff_t>(part.row.size()));
        const auto line = line_between(part.volume, low, 0.2, 0.8);
        const auto axial = slope_between(part.gauge, low, 0.2, 0.8);
        const auto side = slope_between(part.girth, low, 0.2, 0.8);
        const auto crush = line ? offset_yield(l.volume, pressure, *line, crush_offset) : std::nullopt;
        double worst = 0.0;
        for (std::size_t k = 0; k < l.stress.size(); ++k) {
            if (lateral[k] > 0.1 * pressure_) {
                worst = std::max(worst, std::fabs(l.stress[k] / lateral[k] - 1.0));
            }
        }
        std::vector<report::Scalar> out{
            {"bulk_modulus", "Bulk modulus", line ? std::optional(line->slope) : std::nullopt, "Pa",
             "slope of mean pressure over volumetric strain (middle gauge and girth), 20 % to 80 % of the elastic part, in which a "
             "hundredth of "
             "the work is lost"},
            {"strain_ratio", "Lateral over axial strain", axial && side ? std::optional(*axial / *side) : std::nullopt, "",
             "circumferential over middle gauge strain there; isotropic: 1"},
            {"crush_pressure", "Crush pressure", crush, "Pa",
             "where the curve leaves the elastic line, shifted by 0.02 % of volumetric strain (offset yield)"},
            {"volumetric_strain_at_end", "Volumetric strain at the end", l.volume.empty() ? std::nullopt : std::optional(l.volume.back()),
             "", "middle gauge and girth"},
            {"unloading_modulus", "Bulk modulus in unloading", unloading(m.curve), "Pa",
             "secant of mean pressure over volumetric strain from the largest pressure to the end, with unload_to below 1"},
            {"servo_error", "Servo, largest error", worst, "", "axial over lateral stress less 1, from a tenth of the pressure on"}};
        for (auto&& more : {energy_results(m)}) {
            out.insert(out.end(), more.begin(), more.end());
        }
        return out;
    }

    [[nodiscard]] std::vector<PlotSpec> plots() const override {
        return {{"Pressure against strains.",
                 "strain [%]",
                 "axial stress [MPa]",
                 100.0,
                 1e-6,
                 {{"volumetric_strain", "axial_stress", "volumetric", "#1f4e79"},
                  {"gauge_axial_strain", "axial_stress", "axial, middle gauge", "#1e7b46"},
                  {"circumferential_strain", "axial_stress", "circumferential", "#b9770e"}}}};
    }

  private:
    static std::optional<double> unloading(const report::Table& curve) {
        const auto phase = curve.values("phase");
        const auto last = std::find(phase.rbegin(), phase.rend(), phase_loading);
        if (phase.empty() || phase.back() != phase_cycling || last == phase.rend()) {
            return std::nullopt;
        }
        const auto turn = static_cast<std::size_t>(phase.rend() - last) - 1;
        const auto fell = [&](const char* column) { return curve.values(column)[turn] - curve.values(column).back(); };
        const double volume = fell("volumetric_strain");
        return volume > 0.0 ? std::optional((fell("axial_stress") + 2.0 * fell("lateral_stress")) / 3.0 / volume) : std::nullopt;
    }

    static constexpr double pi = 3.14159265358979323846;

    double pressure_ = 100e6;
    input::NumberOrWord ramp_{0.0, "auto"};
    double speed_limit_ = 1.0;
    double unload_to_ = 1.0;
    input::NumberOrWord friction_{0.0, "lubricated"};
};

} // namespace

std::unique_ptr<Protocol> make_hydrostatic() { return std::make_unique<Hydrostatic>(); }

} // namespace proveta
