#include "lab/closing_rate.hpp"

#include <algorithm>
#include <limits>

#include "lab/stages.hpp"

namespace proveta {

void declare_rate(input::Visitor& v, ClosingRate& r) {
    v.number_or_word("rate", r.rate, {{"auto", "fast while the specimen is elastic, slow where bonds break"}}, input::Unit::velocity,
                     {0.0, 10.0, true, false}, "closing speed of the platens, each moving at half of it");
    v.number_or_word("ramp", r.ramp, {{"auto", "the time in which a wave crosses the specimen twenty times"}}, input::Unit::time,
                     input::at_least(0), "time in which the platens reach their speed, unless \"rate\" is \"auto\"");
    v.choice("rate_check", r.check,
             {{"off", "the verdict says that the rate was not checked"},
              {"half_rate", "the test is run again to just past its peak with all speeds halved, which takes twice as many steps to there, "
                            "and the verdict compares the peaks"}},
             "confirmation that the rate does not matter");
}

double lowest_tensile_strain(const Bonds& bonds) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const auto& block : bonds.blocks) {
        const BondLaw& law = bonds.laws[block.law];
        const double strength = law.criterion == Criterion::bond ? law.sigma_f : law.averaged_sigma_f;
        for (auto b = block.begin; b < block.end; ++b) {
            lowest = std::min(lowest, strength * bonds.area[b] / (bonds.stiffness[b] * bonds.length[b]));
        }
    }
    return lowest;
}

Stage closing_stage(const ClosingRate& r, const BenchView& bench, double first_damage, double pace) {
    Stage stage;
    stage.name = "loading";
    if (r.automatic()) {
        const double height = bench.shape.height;
        const RateScale scale{height, bench.wave_speed, first_damage, steps_between_looks(height, bench.wave_speed, bench.model.dt())};
        stage.rate = std::make_shared<RateControl>(scale, pace);
        stage.speeds = [control = stage.rate](const BenchView&, double) {
            const double v = 0.5 * control->rate();
            return std::vector<double>{v, -v};
        };
    } else {
        const double ramp = (r.ramp.word == "auto" ? 20.0 * bench.shape.height / bench.wave_speed : r.ramp.number) / pace;
        stage.speeds = [half = 0.5 * pace * r.rate.number, ramp](const BenchView&, double time) {
            const double v = half * smooth_start(time, ramp);
            return std::vector<double>{v, -v};
        };
    }
    return stage;
}

} // namespace proveta
