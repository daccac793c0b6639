// Uniaxial compression.
#include <algorithm>
#include <cmath>

#include "lab/closing_rate.hpp"
#include "lab/derived.hpp"
#include "lab/protocols/protocol.hpp"
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
             {"ASTM D7012 method C and D", "modulus and Poisson's ratio from gauges at mid-height (tangent, secant and average)",
              "spherical seat: the platens stay parallel"},
             {"EN 12390-13", "secant modulus between a tenth and a third of the strength", "no preloading cycles"}}};
    }

    void declare_loading(input::Visitor& v) override {
        declare_rate(v, rate_);
        declare_friction(v, friction_);
        v.number("platen_stiffness", platen_stiffness_, input::Unit::none, {0.0, 10.0, true, false},
                 "stiffness of the contact between platen and specimen over the one with which the platens add no compliance");
        v.section("stop", stop_, "what ends the test");
        v.refused("confining_pressure", "an unconfined test has free sides; confinement belongs to a triaxial test");
    }

    void check(const SpecimenRecipe& recipe, const std::string& source, const std::string&, input::Problems& problems) const override {
        if (recipe.file.empty() && recipe.spheres < 20) {
            problems.push_back({source, "/specimen/spheres", std::to_string(recipe.spheres), "at least 20 spheres for a compression test",
                                "1,000 spheres give a first impression, 13,500 a good curve"});
        }
    }

    // 2. Stages and 3. controls: platens in contact without load, then closing at the rate, both at half of it.
    [[nodiscard]] std::vector<Platen> platens(const Spheres& spheres, const Shape& shape) const override {
        constexpr double capping = 0.1; // of a radius: what an end's grinding or cap would level out
        const double mu = friction_value(friction_);
        std::vector<Platen> platens{make_platen(spheres, 0.0, 1.0, mu, shape.section(), capping),
                                    make_platen(spheres, shape.height, -1.0, mu, shape.section(), capping)};
        for (auto& platen : platens) {
            platen.area_weight *= platen_stiffness_;
        }
        return platens;
    }

    [[nodiscard]] std::vector<Stage> stages(const BenchView& bench, double pace) const override {
        // Bonds across the load are stretched by Poisson's ratio of the axial strain, some of them twice as far as the mean.
        const double first_damage = std::min(2.5 * lowest_tensile_strain(bench.model.bonds), 0.1 * stop_.axial_strain);
        return {closing_stage(rate_, bench, first_damage, pace)};
    }

    [[nodiscard]] bool checks_rate() const override { return rate_.check == "half_rate"; }

    // 4. Measurements are the bench's; stop rules.
    [[nodiscard]] double strain_range() const override { return stop_.axial_strain; }

    [[nodiscard]] std::optional<std::string> stop(const BenchView& bench) const override { return stopped_by(stop_, bench.curve); }

    // 5. Derived results.
    [[nodiscard]] std::vector<report::Scalar> results(const report::Table& curve, const report::Table& energy) const override {
        const auto stress = curve.values("axial_stress");
        const auto nominal = curve.values("axial_strain");
        const auto gauge = curve.values("gauge_axial_strain");
        const auto lateral = curve.values("circumferential_strain");
        const std::size_t peak = peak_index(stress);
        const double f = stress.empty() ? 0.0 : stress[peak];
        const bool seen = !stress.empty() && stress.back() < 0.95 * f;
        const auto when_seen = [&](double v) { return seen ? std::optional(v) : std::nullopt; };

        const auto e_gauge = slope_between(gauge, stress, 0.1, 1.0 / 3.0);
        const auto e_travel = slope_between(nominal, stress, 0.1, 1.0 / 3.0);
        const auto tangent = slope_between(gauge, stress, 0.4, 0.6);
        const auto average = slope_between(gauge, stress, 0.2, 0.6);
        const auto half = x_at_share(gauge, stress, 0.5);
        const auto lateral_slope = slope_between(lateral, stress, 0.1, 1.0 / 3.0);

        std::optional<double> softening;
        std::optional<std::size_t> below90;
        std::optional<std::size_t> below60;
        for (std::size_t k = peak; k < stress.size(); ++k) {
            if (!below90 && stress[k] < 0.9 * f) {
                below90 = k;
            }
            if (!below60 && stress[k] < 0.6 * f) {
                below60 = k;
            }
        }
        if (below90 && below60) {
            const auto line = fit(nominal, stress, *below90, *below60);
            softening = line ? std::optional(line->slope) : std::nullopt;
        }
        const auto dissipated = [&](const char* what) {
            return energy.rows.empty() ? std::nullopt : std::optional(energy.rows.back()[energy.column(what)]);
        };
        return {
            {"strength", "Compressive strength", when_seen(f), "Pa",
             "largest mean platen stress, once the stress has fallen 5 % below it (ASTM C39)"},
            {"strain_at_peak", "Strain at peak, platens", when_seen(stress.empty() ? 0.0 : nominal[peak]), "", "platen travel over height"},
            {"gauge_strain_at_peak", "Strain at peak, middle gauge", when_seen(stress.empty() ? 0.0 : gauge[peak]), "",
             "middle gauge length"},
            {"young_modulus", "Young's modulus E", e_gauge, "Pa",
             "slope of stress over middle gauge strain, 10 % to 33 % of the strength (EN 12390-13)"},
            {"young_modulus_platens", "Modulus from platen travel", e_travel, "Pa", "the same with platen travel as strain"},
            {"tangent_modulus", "Tangent modulus at 50 %", tangent, "Pa", "slope between 40 % and 60 % of the strength (ASTM D7012)"},
            {"secant_modulus", "Secant modulus at 50 %", half ? std::optional(0.5 * f / *half) : std::nullopt, "Pa",
             "half the strength over its gauge strain (ASTM D7012)"},
            {"average_modulus", "Average modulus", average, "Pa",
             "slope of the straighter part, 20 % to 60 % of the strength (ASTM D7012)"},
            {"poisson_ratio", "Poisson's ratio", e_gauge && lateral_slope ? std::optional(-*e_gauge / *lateral_slope) : std::nullopt, "",
             "minus circumferential over gauge axial strain, 10 % to 33 % of the strength"},
            {"post_peak_slope", "Post-peak slope", softening, "Pa",
             "stress over platen strain between 90 % and 60 % of the strength, falling"},
            {"work", "Work of the platens", dissipated("platens"), "J", "to the end of the test"},
            {"damage_energy", "Energy dissipated by cracking", dissipated("damage"), "J",
             "damage and failure of bonds, to the end of the test"}};
    }

  private:
    ClosingRate rate_;
    input::NumberOrWord friction_{0.3, ""};
    double platen_stiffness_ = 1.0;
    StopRules stop_;
};

} // namespace

std::unique_ptr<Protocol> make_ucs() { return std::make_unique<Ucs>(); }

} // namespace proveta
