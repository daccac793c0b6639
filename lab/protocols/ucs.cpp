// Uniaxial compression.
#include <algorithm>
#include <cmath>

#include "lab/axial_results.hpp"
#include "lab/deck.hpp"
#include "lab/stages.hpp"

namespace proveta {

namespace {

class Ucs : public Protocol {
  public:
    // 1. The standard: what it mimics and where it cannot.
    [[nodiscard]] ProtocolInfo about() const override {
        return {
            "ucs",
            "Uniaxial compression",
            "A cylinder or prism is pressed between two rigid platens, at a steady closing speed or one that the test leads itself, until "
            "its stress has fallen well past the peak, or until an axial strain.",
            {{"ASTM C39, EN 12390-3", "150 x 300 mm cylinder, compressive strength from peak load over nominal area",
              "loading rate: milliseconds instead of minutes, so the verdict on quasi-static loading must hold; no creep, no moisture"},
             {"ASTM D7012 method C and D",
              "modulus and Poisson's ratio from gauges at mid-height (tangent, secant and average); control by "
              "the girth past the peak",
              "spherical seat: the platens stay parallel"},
             {"EN 12390-13", "secant modulus between a tenth and a third of the strength; cycles on request",
              "no preloading cycles by itself"}}};
    }

    void declare_loading(input::Visitor& v) override {
        declare_axial(v, axial_, true);
        declare_friction(v, friction_);
        v.number("platen_stiffness", platen_stiffness_, input::Unit::none, {0.0, 10.0, true, false},
                 "stiffness of the contact between platen and specimen over the one with which the platens add no compliance");
        v.section("stop", stop_, "what ends the test");
        v.refused("confining_pressure", "an unconfined test has free sides; confinement belongs to a triaxial test");
        v.refused("strips", "loading strips belong to a brazilian test");
    }

    void check(const Deck& deck, input::Problems& problems) const override {
        if (deck.specimen.file.empty() && deck.specimen.spheres < 20) {
            problems.push_back({deck.source, "/specimen/spheres", std::to_string(deck.specimen.spheres),
                                "at least 20 spheres for a compression test",
                                "1,000 spheres give a first impression, 13,500 a good curve"});
        }
        check_axial(axial_, stop_.axial_strain, stop_.time, deck, problems);
    }

    // 2. Stages and 3. controls: platens in contact without load, then closing at the rate, both at half of it; cycles; the girth may lead.
    [[nodiscard]] Press press(const InPress& body) const override {
        return axial_press(body.spheres, body.shape, friction_value(friction_), platen_stiffness_);
    }

    [[nodiscard]] std::vector<Stage> stages(const BenchView& bench, double pace) const override {
        // Bonds across the load are stretched by Poisson's ratio of the axial strain, some of them twice as far as the mean.
        const double first_damage = std::min(2.5 * lowest_tensile_strain(bench.model.bonds), 0.1 * stop_.axial_strain);
        return axial_stages(axial_, bench, {stop_.axial_strain, first_damage}, pace);
    }

    [[nodiscard]] bool checks_rate() const override { return axial_.rate.check == "half_rate"; }

    // 4. Measurements are the bench's; stop rules.
    [[nodiscard]] std::optional<std::string> stop(const BenchView& bench) const override { return stopped_by(stop_, bench); }

    // 5. Derived results.
    [[nodiscard]] std::vector<report::Scalar> results(const Measured& m) const override {
        const Loading l = loading_of(m.curve, m.press.sense);
        const std::size_t peak = peak_index(l.stress);
        const auto strength = peak_if_passed(l.stress);
        std::vector<report::Scalar> out{{"strength", "Compressive strength", strength, "Pa",
                                         "largest mean platen stress, once the stress has fallen 5 % below it (ASTM C39)"},
                                        {"strain_at_peak", "Strain at peak, platens",
                                         strength ? std::optional(l.strain[peak]) : std::nullopt, "", "platen travel over height"},
                                        {"gauge_strain_at_peak", "Strain at peak, middle gauge",
                                         strength ? std::optional(l.gauge[peak]) : std::nullopt, "", "middle gauge length"}};
        for (auto&& more : {elastic_results(l), softening_results(l), cycle_results(m.curve, m.press.sense), energy_results(m)}) {
            out.insert(out.end(), more.begin(), more.end());
        }
        return out;
    }

    [[nodiscard]] std::vector<PlotSpec> plots() const override {
        return {stress_strain_plot("Axial stress against strain; the mark is the peak.", "axial_stress")};
    }

  private:
    AxialLoading axial_;
    input::NumberOrWord friction_{0.3, ""};
    double platen_stiffness_ = 1.0;
    StopRules stop_;
};

} // namespace

std::unique_ptr<Protocol> make_ucs() { return std::make_unique<Ucs>(); }

} // namespace proveta
