// Direct tension between glued platens.
#include <algorithm>
#include <cmath>

#include "lab/axial_results.hpp"
#include "lab/deck.hpp"
#include "lab/stages.hpp"

namespace proveta {

namespace {

class DirectTension : public Protocol {
  public:
    DirectTension() {
        stop_.axial_strain = 0.002;
        stop_.post_peak_drop = 0.9;
        stop_.parted = "stop";
    }

    // 1. The standard: what it mimics and where it cannot.
    [[nodiscard]] ProtocolInfo about() const override {
        return {"direct-tension",
                "Direct tension",
                "A cylinder or prism is pulled apart by platens glued to its ends until it has parted.",
                {{"ASTM D2936", "core glued to two platens, strength from the largest load over the section",
                  "no ball joints or chains: the platens stay parallel, so the specimen cannot turn as it tears; no specimen fails in the "
                  "glue"}}};
    }

    void declare_loading(input::Visitor& v) override {
        declare_axial(v, axial_, false);
        v.section("stop", stop_, "what ends the test");
        v.refused("confining_pressure", "a tension test has free sides; confinement belongs to a triaxial test");
        v.refused("platen_friction", "the platens are glued on");
        v.refused("strips", "loading strips belong to a brazilian test");
    }

    void check(const Deck& deck, input::Problems& problems) const override {
        if (deck.specimen.file.empty() && deck.specimen.spheres < 20) {
            problems.push_back({deck.source, "/specimen/spheres", std::to_string(deck.specimen.spheres),
                                "at least 20 spheres for a tension test", "13,500 give a good curve"});
        }
        check_axial(axial_, stop_.axial_strain, stop_.time, deck, problems);
    }

    // 2. Stages and 3. controls: platens glued to the ends, parting at the rate, both at half of it.
    [[nodiscard]] Press press(const InPress& body) const override {
        Press press = axial_press(body.spheres, body.shape, glued, 1.0);
        press.platens[0].bonded = press.platens[1].bonded = true;
        press.sense = -1.0;
        return press;
    }

    [[nodiscard]] std::vector<Stage> stages(const BenchView& bench, double pace) const override {
        const double first_damage = std::min(lowest_tensile_strain(bench.model.bonds), 0.1 * stop_.axial_strain);
        // Little energy is stored when it tears, so that half the speed of a compression test is as quiet.
        const double led = axial_.rate.automatic() ? 0.5 : 1.0;
        return axial_stages(axial_, bench, {stop_.axial_strain, first_damage}, led * pace);
    }

    [[nodiscard]] bool checks_rate() const override { return axial_.rate.check == "half_rate"; }

    // 4. Measurements are the bench's; stop rules.
    [[nodiscard]] std::optional<std::string> stop(const BenchView& bench) const override { return stopped_by(stop_, bench); }

    // 5. Derived results, tension positive.
    [[nodiscard]] std::vector<report::Scalar> results(const Measured& m) const override {
        const Loading l = loading_of(m.curve, m.press.sense);
        const std::size_t peak = peak_index(l.stress);
        const auto strength = peak_if_passed(l.stress);
        const auto line = line_between(l.gauge, l.stress, 0.1, 1.0 / 3.0);
        const auto lateral = slope_between(l.girth, l.stress, 0.1, 1.0 / 3.0);
        double area = 0.0; // under stress over platen travel
        double until_peak = 0.0;
        for (std::size_t k = 1; k < l.strain.size(); ++k) {
            area += 0.5 * (l.stress[k] + l.stress[k - 1]) * (l.strain[k] - l.strain[k - 1]) * m.press.length;
            until_peak = k <= peak ? area : until_peak;
        }
        const bool torn = !l.stress.empty() && l.stress.back() < 0.2 * l.stress[peak];
        // What the specimen holds at the peak goes into the crack; what had been lost in it by then does not.
        const auto elastic = line ? std::optional(0.5 * l.stress[peak] * l.stress[peak] / line->slope * m.press.length) : std::nullopt;
        std::vector<report::Scalar> out{
            {"tensile_strength", "Tensile strength", strength, "Pa",
             "largest mean platen stress, tension positive, once the stress has fallen 5 % below it (ASTM D2936)"},
            {"strain_at_peak", "Strain at peak, platens", strength ? std::optional(l.strain[peak]) : std::nullopt, "",
             "platen travel over height"},
            {"young_modulus", "Young's modulus E in tension", line ? std::optional(line->slope) : std::nullopt, "Pa",
             "slope of stress over middle gauge strain, 10 % to 33 % of the strength"},
            {"poisson_ratio", "Poisson's ratio", line && lateral ? std::optional(-line->slope / *lateral) : std::nullopt, "",
             "minus circumferential over gauge axial strain, 10 % to 33 % of the strength"},
            {"fracture_energy", "Fracture energy", torn && elastic ? std::optional(area - until_peak + *elastic) : std::nullopt, "J/m2",
             "of the crack: area under stress over platen travel from the peak on, and the elastic energy at the peak, once less than a "
             "fifth "
             "of it is left"},
            {"work_of_fracture", "Work of fracture", torn ? std::optional(area) : std::nullopt, "J/m2",
             "whole area under stress over platen travel, with what cracks all over the specimen took before the peak"}};
        for (auto&& more : {softening_results(l), cycle_results(m.curve, m.press.sense), energy_results(m)}) {
            out.insert(out.end(), more.begin(), more.end());
        }
        return out;
    }

    [[nodiscard]] std::vector<PlotSpec> plots() const override {
        PlotSpec spec = stress_strain_plot("Stress against strain, tension positive; the mark is the peak.", "axial_stress");
        spec.x_title = "axial strain, stretching positive [%]";
        spec.y_title = "tensile stress [MPa]";
        spec.x_scale = -100.0;
        spec.y_scale = -1e-6;
        return {spec};
    }

  private:
    AxialLoading axial_;
    StopRules stop_;
};

} // namespace

std::unique_ptr<Protocol> make_direct_tension() { return std::make_unique<DirectTension>(); }

} // namespace proveta
