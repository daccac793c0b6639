// Compression along the axis while the side cannot move.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/input/units.hpp"
#include "lab/axial_results.hpp"
#include "lab/confinement.hpp"
#include "lab/deck.hpp"
#include "lab/stages.hpp"

namespace proveta {

namespace {

constexpr double yield_offset = 0.0002;
constexpr double ring_capping = 0.2; // of a radius: the specimen is cast or pressed into its ring

class Oedometric : public Protocol {
  public:
    Oedometric() {
        stop_.axial_strain = 0.02;
        stop_.post_peak_drop = 1.0;
    }

    // 1. The standard: what it mimics and where it cannot.
    [[nodiscard]] ProtocolInfo about() const override {
        return {"oedometric",
                "Oedometric compression",
                "A specimen in a rigid ring (a prism between four rigid walls) is pressed along its axis, so that its side cannot move.",
                {{"ASTM D2435", "one-dimensional compression with a rigid smooth ring; constrained modulus, cycles on request",
                  "no steps of load, no consolidation in time, no water; the platens move on steadily"},
                 {"Uniaxial strain compaction", "lateral strain held at zero, axial and lateral stress, K0, yield",
                  "the ring holds by contact, not by a servo on the girth: what its contacts give way by is reported as lateral strain"}}};
    }

    void declare_loading(input::Visitor& v) override {
        declare_axial(v, axial_, false);
        v.number_or_word("ring_diameter", ring_, {{"auto", "that of the specimen"}}, input::Unit::length, input::above(0),
                         "inner diameter of the ring around a round specimen");
        v.number("ring_friction", ring_friction_, input::Unit::none, {0.0, 10.0, false, false},
                 "Coulomb friction between specimen and ring");
        declare_friction(v, friction_);
        v.section("stop", stop_, "what ends the test");
        v.refused("confining_pressure", "the ring holds the side; a pressure there belongs to a triaxial test");
        v.refused("strips", "loading strips belong to a brazilian test");
    }

    void check(const Deck& deck, input::Problems& problems) const override {
        check_sides(deck, problems);
        if (ring_.word.empty() && deck.specimen.file.empty()) {
            if (deck.specimen.shape == "prism") {
                problems.push_back(
                    {deck.source, "/loading/ring_diameter", fmt_length(ring_.number), "no ring: a prism stands between four walls", ""});
            } else if (ring_.number < deck.specimen.diameter) {
                problems.push_back({deck.source, "/loading/ring_diameter", fmt_length(ring_.number),
                                    "at least the specimen's diameter of " + fmt_length(deck.specimen.diameter),
                                    "\"auto\" fits the specimen"});
            }
        }
        check_axial(axial_, stop_.axial_strain, stop_.time, deck, problems);
    }

    // 2. Stages and 3. controls: platens closing; ring or walls at rest.
    [[nodiscard]] Press press(const InPress& body) const override {
        Press press = axial_press(body.spheres, body.shape, friction_value(friction_), 1.0);
        if (body.shape.kind == ShapeKind::cylinder) {
            const double radius = 0.5 * (ring_.word.empty() ? ring_.number : body.shape.diameter);
            if (radius < 0.5 * body.shape.diameter * (1.0 - 1e-9)) {
                throw std::invalid_argument("a specimen wider than the ring (loading.ring_diameter)");
            }
            press.side_area = pi * body.shape.diameter * body.shape.height;
            // Where the ring stands off, nothing touches it at the start.
            press.platens.push_back(make_platen(body.spheres, ring_face(radius), -radius, ring_friction_, press.side_area, ring_capping));
        } else if (body.shape.kind == ShapeKind::prism) {
            press.side_area = 2.0 * (body.shape.width + body.shape.depth) * body.shape.height;
            for (const bool across_x : {true, false}) {
                for (const double inward : {1.0, -1.0}) {
                    const Face face{across_x ? Vec3::UnitX() : Vec3::UnitY(), inward, 0.0, Face::boundless};
                    const double half = 0.5 * (across_x ? body.shape.width : body.shape.depth);
                    const double area = (across_x ? body.shape.depth : body.shape.width) * body.shape.height;
                    press.platens.push_back(make_platen(body.spheres, face, -inward * half, ring_friction_, area, ring_capping));
                }
            }
        } else {
            throw std::invalid_argument("a plate, which has no side for a ring");
        }
        for (std::size_t side = 2; side < press.platens.size(); ++side) {
            press.platens[side].area_weight *= ring_stiffening;
        }
        return press;
    }

    [[nodiscard]] std::vector<Stage> stages(const BenchView& bench, double pace) const override {
        // Nothing is stretched: the first bonds fail in shear or crush, well after they would in tension.
        const double first_damage = std::min(5.0 * lowest_tensile_strain(bench.model.bonds), 0.1 * stop_.axial_strain);
        return axial_stages(axial_, bench, {stop_.axial_strain, first_damage}, pace);
    }

    [[nodiscard]] bool checks_rate() const override { return axial_.rate.check == "half_rate"; }

    // 4. Measurements are the bench's; stop rules.
    [[nodiscard]] std::optional<std::string> stop(const BenchView& bench) const override { return stopped_by(stop_, bench); }

    // 5. Derived results.
    [[nodiscard]] std::vector<report::Scalar> results(const Measured& m) const override {
        const Loading l = loading_of(m.curve, m.press.sense);
        const Loading part = first_samples(l, elastic_samples(m, l));
        std::vector<double> lateral;
        for (std::size_t k = 0; k < part.stress.size(); ++k) {
            lateral.push_back(part.stress[k] - part.deviator[k]);
        }
        const auto line = line_between(part.gauge, part.stress, 0.2, 0.8);
        const auto k0 = slope_between(lateral, part.stress, 0.2, 0.8);
        const auto give = slope_between(part.girth, part.stress, 0.2, 0.8);
        const auto yield = line ? offset_yield(l.gauge, l.stress, *line, yield_offset) : std::nullopt;
        const auto last = [](const std::vector<double>& of) { return of.empty() ? std::nullopt : std::optional(of.back()); };
        std::vector<report::Scalar> out{
            {"constrained_modulus", "Constrained modulus", line ? std::optional(line->slope) : std::nullopt, "Pa",
             "slope of axial stress over middle gauge strain, 20 % to 80 % of the elastic part, in which a hundredth of the work is lost"},
            {"k0", "K0", k0 ? std::optional(1.0 / *k0) : std::nullopt, "",
             "slope of lateral over axial stress there; elastic: nu/(1 - nu)"},
            {"lateral_give", "Lateral over axial strain", line && give ? std::optional(line->slope / *give) : std::nullopt, "",
             "circumferential over middle gauge strain there: what the ring's contacts give way by; 0 is rigid"},
            {"yield_stress", "Yield, axial stress", yield, "Pa",
             "where the curve leaves the elastic line, shifted by 0.02 % strain (offset yield)"},
            {"axial_stress_at_end", "Axial stress at the end", last(l.stress), "Pa", "mean of both platens"},
            {"strain_at_end", "Axial strain at the end", last(l.strain), "", "platen travel over height"},
            {"lateral_stress_at_end", "Lateral stress at the end",
             l.stress.empty() ? std::nullopt : std::optional(l.stress.back() - l.deviator.back()), "Pa",
             "pressure of the specimen on the ring"}};
        for (auto&& more : {cycle_results(m.curve, m.press.sense), energy_results(m)}) {
            out.insert(out.end(), more.begin(), more.end());
        }
        return out;
    }

    [[nodiscard]] std::vector<PlotSpec> plots() const override {
        return {{"Axial and lateral stress against axial strain.",
                 "axial strain [%]",
                 "stress [MPa]",
                 100.0,
                 1e-6,
                 {{"axial_strain", "axial_stress", "axial, platens", "#1f4e79"},
                  {"gauge_axial_strain", "axial_stress", "axial, middle gauge", "#1e7b46"},
                  {"axial_strain", "lateral_stress", "lateral", "#b9770e"}}},
                {"Stress path.",
                 "axial stress [MPa]",
                 "lateral stress [MPa]",
                 1e-6,
                 1e-6,
                 {{"axial_stress", "lateral_stress", "path", "#1f4e79"}}}};
    }

  private:
    static std::string fmt_length(double metres) { return input::format_quantity(metres, input::Unit::length); }
    static constexpr double pi = std::numbers::pi;
    // A contact stands for the matter between a sphere's centre and the ring, which the axial strain makes press on the ring too: a spring
    // of that matter alone would give way instead and take a tenth off K0.
    static constexpr double ring_stiffening = 8.0;

    AxialLoading axial_;
    input::NumberOrWord ring_{0.0, "auto"};
    double ring_friction_ = 0.0;
    input::NumberOrWord friction_{0.0, "lubricated"};
    StopRules stop_;
};

} // namespace

std::unique_ptr<Protocol> make_oedometric() { return std::make_unique<Oedometric>(); }

} // namespace proveta
