// Drained triaxial compression of loose matter in a rubber membrane.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/input/units.hpp"
#include "lab/axial_results.hpp"
#include "lab/confinement.hpp"
#include "lab/deck.hpp"
#include "lab/granular_results.hpp"
#include "lab/membrane.hpp"
#include "lab/stages.hpp"

namespace proveta {

namespace {

constexpr double slow_flow = 1e-3; // inertial number below which granular flow counts as quasi-static (GDR MiDi, Eur. Phys. J. E 14, 2004)

// Ends of the test, whichever comes first.
struct FlowStop {
    double axial_strain = 0.12;
    input::NumberOrWord time{0.0, "never"};
};

void declare(input::Visitor& v, FlowStop& s) {
    v.number("axial_strain", s.axial_strain, input::Unit::none, {0.0, 0.5, true, false},
             "axial strain, since the loading began, at which the test ends");
    v.number_or_word("time", s.time, {{"never", "however long it takes"}}, input::Unit::time, {0.0, 1e6, true, false},
                     "time of the test at which it ends");
}

class GranularTriaxial : public Protocol {
  public:
    GranularTriaxial() { confinement_.pressure = 45e3; }

    // 1. The standard: what it mimics and where it cannot.
    [[nodiscard]] ProtocolInfo about() const override {
        return {
            "granular-triaxial",
            "Triaxial compression of loose matter",
            "A cylinder filled with stones or spheres stands between two platens in a rubber membrane. It is consolidated under an equal "
            "pressure on membrane and platens, and then pressed along its axis at that pressure, far into shear. Stress is force over the "
            "mean section at the time; the change of volume is that inside the membrane.",
            {{"ASTM D7181, EN ISO 17892-9",
              "isotropic consolidation, drained axial loading at constant cell pressure, corrected area, "
              "correction for the membrane's hoop tension",
              "no water: drained means that nothing in the pores bears; the bed is poured and pressed, not vibrated"},
             {"Large triaxial cells for ballast, 300 x 600 mm", "size, grading, membrane and cell pressures from 10 to 240 kPa",
              "stones do not break nor lose corners; their contacts are softer than rock's"}}};
    }

    void suggest(SpecimenRecipe& recipe) const override {
        recipe.matter = "granular";
        recipe.diameter = 0.3;
        recipe.height = 0.6;
        recipe.particles.filling_friction = 0.2; // a bed about as dense as compacted ballast, some 40 % of voids
    }
    [[nodiscard]] std::string card() const override { return "ballast"; }
    [[nodiscard]] bool granular() const override { return true; }
    [[nodiscard]] double pressure() const override { return confinement_.pressure; }
    [[nodiscard]] double gravity() const override { return gravity_; }

    void declare_loading(input::Visitor& v) override {
        v.number_or_word("rate", rate_.rate,
                         {{"auto", "so slow that the inertial number is a thousandth: grains move little while one falls into its place"}},
                         input::Unit::velocity, {0.0, 10.0, true, false}, "speed at which the platens approach, each moving at half of it");
        v.number_or_word("ramp", rate_.ramp, {{"auto", "the time in which a wave crosses the specimen twenty times"}}, input::Unit::time,
                         input::at_least(0), "time in which the platens reach their speed");
        v.choice("rate_check", rate_.check,
                 {{"off", "the verdict says that the rate was not checked"},
                  {"half_rate", "the test is run again with all speeds halved, and the verdict compares the peaks"}},
                 "confirmation that the rate does not matter");
        v.list("cycles", cycles_, "unloading and reloading, in the order in which the loading meets them");
        declare(v, confinement_);
        v.section("membrane", membrane_, "the rubber around the specimen");
        declare_friction(v, friction_);
        v.number(
            "gravity", gravity_, input::Unit::acceleration, input::at_least(0),
            "gravity during the test, downwards; 0 leaves the weight of the specimen out, which at low pressures makes it stronger below "
            "than above");
        v.section("stop", stop_, "what ends the test");
        v.refused("control", "loose matter does not run away past its peak: the platens lead the test");
        v.refused("strips", "loading strips belong to a brazilian test");
    }

    void check(const Deck& deck, input::Problems& problems) const override {
        if (confinement_.pressure <= 0.0) {
            problems.push_back(
                {deck.source, "/loading/confining_pressure", "0", "a pressure above 0", "loose matter has no strength without"});
        }
        check_membrane(deck, problems);
        check_axial(loading(0.0), stop_.axial_strain, stop_.time, deck, problems);
        if (friction_.word == "glued") {
            problems.push_back(
                {deck.source, "/loading/platen_friction", "\"glued\"", "a number or \"lubricated\"", "stones are not glued on"});
        }
    }

    // 2. Stages and 3. controls: all round to the pressure, the platens on a servo; a pause; axial loading.
    [[nodiscard]] Press press(const InPress& body) const override {
        Press press;
        const Material& stone = body.materials.front();
        // The platens just touch, as the membrane does: the bed's overlaps with what it was pressed by are of other moduli.
        double low = body.shape.height;
        double high = 0.0;
        for (std::size_t k = 0; k < body.spheres.size(); ++k) {
            low = std::min(low, body.spheres.position.z[k] - body.spheres.radius[k]);
            high = std::max(high, body.spheres.position.z[k] + body.spheres.radius[k]);
        }
        press.platens = {make_wall(body.spheres, {}, low, stone, friction_value(friction_)),
                         make_wall(body.spheres, {.inward = -1.0}, high, stone, friction_value(friction_))};
        press.length = high - low;
        press.area = body.shape.section();
        press.area_now = true;
        press.inner = body.shape.inner(0.6, 0.6);
        press.bodies.push_back(
            make_membrane(membrane_, {body.shape, body.spheres, 0.4 * body.grain, body.shape.height / body.wave_speed, stone}));
        return press;
    }

    [[nodiscard]] std::vector<Stage> stages(const BenchView& bench, double pace) const override {
        std::vector<Stage> stages = isotropic_stages(confinement_, bench, 0.15, pace);
        const AxialLoading axial = loading(speed(bench));
        for (auto& stage : axial_stages(axial, bench, {stop_.axial_strain, 0.0, confinement_.pressure, 0.82}, pace)) {
            stages.push_back(std::move(stage));
        }
        return stages;
    }

    [[nodiscard]] bool checks_rate() const override { return rate_.check == "half_rate"; }

    // 4. Measurements are the bench's; stop rules.
    [[nodiscard]] std::optional<std::string> stop(const BenchView& bench) const override {
        StopRules rules;
        rules.axial_strain = stop_.axial_strain;
        rules.post_peak_drop = 1.0;
        rules.time = stop_.time;
        return stopped_by(rules, bench);
    }

    // 5. Derived results.
    [[nodiscard]] std::vector<report::Scalar> results(const Measured& m) const override {
        return granular_results(m, confinement_.pressure, membrane_);
    }

    [[nodiscard]] std::vector<PlotSpec> plots() const override {
        PlotSpec deviator = stress_strain_plot("Deviatoric stress against strain, the consolidation included.", "deviatoric_stress");
        deviator.y_title = "deviatoric stress [kPa]";
        deviator.y_scale = 1e-3;
        deviator.curves.resize(1);
        return {deviator,
                {"Volumetric against axial strain, from the volume inside the membrane: up is compaction, down dilation.",
                 "axial strain [%]",
                 "volumetric strain [%]",
                 100.0,
                 100.0,
                 {{"axial_strain", "volumetric_strain", "volume", "#1e7b46"}}},
                {"What the membrane itself bears along the axis.",
                 "axial strain [%]",
                 "force [kN]",
                 100.0,
                 1e-3,
                 {{"axial_strain", "membrane_force", "membrane", "#7d3c98"}}}};
    }

  private:
    // The closing speed at an inertial number of a thousandth: I = rate d sqrt(rho / p), with the rate of axial strain.
    [[nodiscard]] double speed(const BenchView& bench) const {
        const Material& stone = bench.model.materials.front();
        return slow_flow * std::sqrt(confinement_.pressure / stone.density) / bench.grain * bench.press.length;
    }

    // A Neo-Hookean sheet over a hole of radius r bears at most about 0.62 times 2 mu t / r, beyond which it blows up like a balloon. The
    // holes between stones are taken to have 0.3 of their size.
    void check_membrane(const Deck& deck, input::Problems& problems) const {
        if (!deck.specimen.file.empty()) {
            return; // what its grains are is seen later
        }
        const double hole = 0.3 * typical_size(deck.specimen.particles);
        const double shear = membrane_.young_modulus / (2.0 * (1.0 + membrane_.poisson_ratio));
        const double least = confinement_.pressure * hole / (1.24 * shear);
        if (membrane_.thickness < least) {
            problems.push_back({deck.source, "/loading/membrane/thickness",
                                input::format_quantity(membrane_.thickness, input::Unit::length),
                                fmt::format("at least {:.3g} mm: under {} thinner rubber of this modulus blows up between the particles",
                                            1e3 * least, input::format_quantity(confinement_.pressure, input::Unit::pressure)),
                                "or a stiffer membrane"});
        }
    }

    // Diameter that half of the mass passes, m.
    static double typical_size(const BedRecipe& bed) {
        if (bed.size.word.empty()) {
            return bed.size.number;
        }
        for (std::size_t k = 1; k < bed.grading.size(); ++k) {
            const auto& low = bed.grading[k - 1];
            const auto& high = bed.grading[k];
            if (high.passing >= 0.5) {
                return low.diameter + (high.diameter - low.diameter) * (0.5 - low.passing) / (high.passing - low.passing);
            }
        }
        return bed.grading.back().diameter;
    }

    [[nodiscard]] AxialLoading loading(double automatic) const {
        AxialLoading out;
        out.rate = rate_;
        out.cycles = cycles_;
        if (rate_.automatic()) {
            out.rate.rate = {automatic, ""};
        }
        return out;
    }

    ClosingRate rate_;
    std::vector<Cycle> cycles_;
    Confinement confinement_;
    MembraneInput membrane_;
    input::NumberOrWord friction_{0.5, ""};
    double gravity_ = 0.0;
    FlowStop stop_;
};

} // namespace

std::unique_ptr<Protocol> make_granular_triaxial() { return std::make_unique<GranularTriaxial>(); }

} // namespace proveta
