// What the kinds of study vary, and their words.
#pragma once

#include "lab/study/study.hpp"

namespace proveta {

/// How a kind of study varies a deck, and its words.
struct Variation {
    const char* name; // in a plan
    const char *section, *key;
    const char* title;   // of the study
    const char* axis;    // of plots
    const char* limit;   // of what is extrapolated
    double axis_factor;  // from x to the axis' unit
    const char* heading; // of the table's column
    const char* unit;    // of a value, as it follows it
};

inline const Variation& variation(StudyKind kind) {
    static const Variation rate{"rate",      "loading", "rate",     "loading rate", "closing speed of the platens [m/s]",
                                "at rate 0", 1.0,       "rate_m/s", " m/s"};
    static const Variation step{"step",      "numerics", "safety",           "time step",          "time step over the stable one",
                                "at step 0", 1.0,        "step_over_stable", " of the stable step"};
    static const Variation size{"size",      "specimen", "spheres", "number of spheres", "spacing of the spheres (V/n)^(1/3) [mm]",
                                "at size 0", 1e3,        "spheres", " spheres"};
    return kind == StudyKind::rate ? rate : kind == StudyKind::step ? step : size;
}

} // namespace proveta
