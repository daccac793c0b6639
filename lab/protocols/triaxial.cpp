// Triaxial compression under a constant pressure on the side.
#include <algorithm>
#include <cmath>

#include "lab/axial_results.hpp"
#include "lab/confinement.hpp"
#include "lab/deck.hpp"
#include "lab/membrane.hpp"
#include "lab/stages.hpp"
#include "lab/surface_pressure.hpp"

namespace proveta {

namespace {

class Triaxial : public Protocol {
  public:
    Triaxial() { stop_.axial_strain = 0.02; }

    // 1. The standard: what it mimics and where it cannot.
    [[nodiscard]] ProtocolInfo about() const override {
        return {
            "triaxial",
            "Triaxial compression",
            "A cylinder or prism is brought under an equal pressure on all sides, which is held, and then pressed along its axis at that "
            "pressure on its side until its stress has fallen well past the peak, or until an axial strain.",
            {{"ASTM D7012 method A and B", "isotropic stage, axial loading at constant confining pressure; peak, E and nu from gauges",
              "the pressure acts on the surface spheres unless \"confinement\" asks for a membrane; dry, no pore pressure"},
             {"Sfer et al. 2002", "150 x 300 mm cylinder, the same series of pressures, axial control to past the peak",
              "their 0.0006 mm/s; control by the girth at low pressure is an option, not the default"}}};
    }

    void declare_loading(input::Visitor& v) override {
        declare_axial(v, axial_, true);
        declare(v, confinement_);
        v.choice("confinement", confined_by_,
                 {{"spheres", "the pressure acts on the surface spheres, normalised to the true surface (thesis 5.5.3)"},
                  {"membrane", "it acts on a rubber membrane that the spheres press against"}},
                 "how the pressure reaches the side");
        if (v.wants_all() || confined_by_ == "membrane") {
            v.section("membrane", membrane_, "the rubber around the specimen");
        }
        declare_friction(v, friction_);
        v.section("stop", stop_, "what ends the test");
        v.refused("strips", "loading strips belong to a brazilian test");
    }

    void check(const Deck& deck, input::Problems& problems) const override {
        check_sides(deck, problems);
        check_confinement(confinement_, deck, problems);
        if (confined_by_ == "membrane" && deck.specimen.file.empty() && deck.specimen.shape == "prism") {
            problems.push_back(
                {deck.source, "/loading/confinement", "\"membrane\" around a prism", "a specimen that is round", "or \"spheres\""});
        }
        check_axial(axial_, stop_.axial_strain, stop_.time, deck, problems);
    }

    // 2. Stages and 3. controls: all sides to the pressure, the platens on a servo; a pause; axial loading.
    [[nodiscard]] Press press(const InPress& body) const override {
        Press press = axial_press(body.spheres, body.shape, friction_value(friction_), 1.0);
        if (confined_by_ == "membrane") {
            press.bodies.push_back(make_membrane(
                membrane_, {body.shape, body.spheres, 2.0 * body.grain, body.shape.height / body.wave_speed, body.materials.front()}));
        } else {
            press.pressures = {lateral_pressure(body.shape, body.spheres, body.bonds)};
        }
        return press;
    }

    [[nodiscard]] std::vector<Stage> stages(const BenchView& bench, double pace) const override {
        std::vector<Stage> stages = isotropic_stages(confinement_, bench, 0.1, pace);
        const double first_damage = std::min(2.5 * lowest_tensile_strain(bench.model.bonds), 0.1 * stop_.axial_strain);
        const AxialTarget target{stop_.axial_strain, first_damage, confinement_.pressure, stages.empty() ? 1.0 : 0.88};
        for (auto& stage : axial_stages(axial_, bench, target, pace)) {
            stages.push_back(std::move(stage));
        }
        return stages;
    }

    [[nodiscard]] bool checks_rate() const override { return axial_.rate.check == "half_rate"; }

    // 4. Measurements are the bench's; stop rules.
    [[nodiscard]] std::optional<std::string> stop(const BenchView& bench) const override { return stopped_by(stop_, bench); }

    // 5. Derived results.
    [[nodiscard]] std::vector<report::Scalar> results(const Measured& m) const override {
        const Loading whole = loading_of(m.curve, m.press.sense);
        const Loading l = until_recovery(whole);
        const std::size_t peak = peak_index(l.deviator);
        const auto passed = peak_if_passed(l.deviator);
        const auto at_peak = [&](const std::vector<double>& of) { return passed ? std::optional(of[peak]) : std::nullopt; };
        const auto at_two = y_at(whole.strain, whole.stress, 0.02 * (1.0 - 1e-6));
        const auto strength = passed ? at_peak(l.stress) : at_two;
        std::vector<report::Scalar> out{
            {"confining_pressure", "Confining pressure", confinement_.pressure, "Pa", "pressure on the side, held constant"},
            {"strength", "Strength, total axial stress", strength, "Pa",
             "total axial stress at the first peak of the deviator that it falls 5 % below, whether or not it rises again; without a peak "
             "the "
             "stress at 2 % axial strain"},
            {"peak_total_stress", "Peak total axial stress", at_peak(l.stress), "Pa", "at the largest deviator, once it has fallen by 5 %"},
            {"peak_deviatoric_stress", "Peak deviatoric stress", passed, "Pa", "the same less the confining pressure"},
            {"stress_at_2_percent", "Total axial stress at 2 % axial strain", at_two, "Pa", "platen strain since the axial loading began"},
            {"strain_at_peak", "Strain at peak, platens", at_peak(l.strain), "", "platen travel over height since the axial loading began"},
            {"gauge_strain_at_peak", "Strain at peak, middle gauge", at_peak(l.gauge), "", "middle gauge length, the same"},
            {"residual_stress", "Residual deviatoric stress", residual(whole), "Pa",
             "mean over the last tenth of the strain, once the deviator has fallen by 5 %"},
            {"dilatancy", "Dilatancy", dilatancy(l), "",
             "minus volumetric over axial strain increment by the middle gauges, from 90 % to 100 % of the largest deviator: positive when "
             "the "
             "specimen grows"}};
        for (auto&& more : {elastic_results(l), softening_results(l), cycle_results(m.curve, m.press.sense), energy_results(m)}) {
            out.insert(out.end(), more.begin(), more.end());
        }
        return out;
    }

    [[nodiscard]] std::vector<PlotSpec> plots() const override {
        PlotSpec deviator = stress_strain_plot("Deviatoric stress against strain, the isotropic stage included.", "deviatoric_stress");
        deviator.y_title = "deviatoric stress [MPa]";
        return {deviator,
                {"Volumetric against axial strain, middle gauges: up is compaction.",
                 "axial strain [%]",
                 "volumetric strain [%]",
                 100.0,
                 100.0,
                 {{"axial_strain", "volumetric_strain", "volume", "#1e7b46"}}}};
    }

  private:
    static std::optional<double> residual(const Loading& l) {
        if (!peak_if_passed(l.deviator)) {
            return std::nullopt;
        }
        double sum = 0.0;
        double count = 0.0;
        for (std::size_t k = 0; k < l.strain.size(); ++k) {
            if (l.strain[k] >= 0.9 * l.strain.back()) {
                sum += l.deviator[k];
                count += 1.0;
            }
        }
        return sum / count;
    }

    static std::optional<double> dilatancy(const Loading& l) {
        const auto slope = slope_between(l.gauge, l.deviator, 0.9, 1.0);
        const std::size_t peak = peak_index(l.deviator);
        const auto first = l.deviator.empty() ? std::nullopt : first_reaching(l.deviator, 0.9 * l.deviator[peak], peak);
        const auto line = slope && first ? fit(l.gauge, l.volume, *first, peak) : std::nullopt;
        return line ? std::optional(-line->slope) : std::nullopt;
    }

    AxialLoading axial_;
    Confinement confinement_;
    std::string confined_by_ = "spheres";
    MembraneInput membrane_;
    input::NumberOrWord friction_{0.3, ""};
    StopRules stop_;
};

} // namespace

std::unique_ptr<Protocol> make_triaxial() { return std::make_unique<Triaxial>(); }

} // namespace proveta
