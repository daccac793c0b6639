// The platens' speed under `"rate": "auto"`: fast while the specimen is elastic, slow where bonds break.
//
// Speeds are counted in strain per crossing of a stress wave, u = v / c (height H, wave speed c, crossing time H / c: u = v H / (H c)),
// which makes the rules the same for every size and stiffness. With e the axial strain so far and eta = u / e the share of the strain that
// comes on during one crossing:
//
//  * An elastic specimen closing at eta has kinetic over elastic energy eta^2 / 12: eta_fast is bounded by the quasi-static verdict.
//    What has been crushed stores nothing: where bonds yield in compression, e counts in the share of its work that is elastic.
//  * A crack needs about one crossing to run; what the stress gains meanwhile, about eta of the strength, is the rate's error. Once bonds
//    break, eta falls to eta_slow, e being held at what it was then. What leads it is the damage ratio: energy dissipated by damage over
//    the work put in, of late. It is 0 in the elastic range, whatever the speed, and its order of magnitude at the peak depends little on
//    the specimen.
//  * Kinetic over elastic energy, the unbalanced force ratio and the difference of the platens' forces above half of what the verdict
//    allows lower the speed further.
//  * Acceleration costs stress differences of (1/8) (du/dt H/c) / e: it is bounded by a share of e, and follows its aim with a lag, so
//    that no wave starts.
//
// Everything is a function of steps and of the model's state: the same test gives the same speeds. The few numbers that `visit` names are
// the whole state.
#pragma once

#include <cstdint>

#include "core/model.hpp"

namespace proveta {

/// Scales of a test that is to be paced.
struct RateScale {
    double height = 0.0;           ///< along which the platens close, m
    double wave_speed = 0.0;       ///< m/s
    double first_damage = 0.0;     ///< axial strain below which no bond fails, an estimate that the start is scaled by
    std::int64_t steps_a_look = 1; ///< steps between two looks at the model, see `steps_between_looks`
};

/// What the controller looks at.
struct RateReading {
    double strain = 0.0;     ///< axial, of the specimen, growing with the closing of the platens
    double work = 0.0;       ///< put into the specimen so far, J
    double damage = 0.0;     ///< dissipated by damage so far, J
    double kinetic = 0.0;    ///< energy, J
    double elastic = 0.0;    ///< energy, J
    double plastic = 0.0;    ///< dissipated by yielding in compression so far, J
    double unbalanced = 0.0; ///< force ratio
    double imbalance = 0.0;  ///< difference of the platens' forces over their mean
};

/// Steps between looks: a quarter of a wave's crossing, from 10 to 100 steps.
std::int64_t steps_between_looks(double height, double wave_speed, double dt);

class RateControl {
  public:
    /// pace: factor on all speeds; 0.5 for the half-rate check.
    RateControl(const RateScale& scale, double pace);

    /// The platens move at `speed` m/s, perhaps backwards: go on from there.
    void start(double speed) {
        speed_ = speed / scale_.wave_speed;
        gain_ = 0.0;
    }

    /// Closing speed for the next step, m/s, never negative once it has been positive.
    [[nodiscard]] double rate() const { return speed_ * scale_.wave_speed; }
    /// True when the step after `steps` steps is one to look at.
    [[nodiscard]] bool looks_at(std::int64_t steps) const { return steps % scale_.steps_a_look == 0; }

    /// Takes in what a measured step found.
    void observe(const RateReading& reading);
    /// Goes on by one step of dt seconds.
    void advance(double dt);

    /// Calls visit(name, value) for the state.
    template <class Visit> void visit(Visit&& visit) {
        visit("speed", speed_);
        visit("gain", gain_);
        visit("aim", aim_);
        visit("strain", strain_);
        visit("work", work_);
        visit("damage", damage_);
        visit("recent_work", recent_work_);
        visit("recent_damage", recent_damage_);
        visit("slow_from", slow_from_);
    }

    /// Damage ratio that leads the speed now.
    [[nodiscard]] double damage_ratio() const { return recent_work_ > 0.0 ? recent_damage_ / recent_work_ : 0.0; }

  private:
    RateScale scale_;
    double pace_;
    double speed_ = 0.0; // u, strain per crossing
    double gain_ = 0.0;  // du per crossing
    double aim_ = 0.0;   // u that the last look asked for
    double strain_ = 0.0;
    double work_ = 0.0; // at the last look, J
    double damage_ = 0.0;
    double recent_work_ = 0.0; // with the past forgotten, J
    double recent_damage_ = 0.0;
    double slow_from_ = 0.0; // strain at which damage began to rule the speed; 0: it does not
};

} // namespace proveta
