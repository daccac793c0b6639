// Acoustic emission: failures of bonds that belong together, as a sensor on the specimen would hear them.
//
// Bonds that fail close to each other and shortly after one another are one crack that runs. J. F. Hazzard and R. P. Young (Int. J. Rock
// Mech. Min. Sci. 37 (2000) 867) cluster the cracks of a bonded-particle model in space and time, with a duration of twice the travel time
// of a shear wave across the source. Here two failures are linked when they are at most `reach` mean diameters apart and their times differ
// by at most `patience` times what a wave of speed c needs for that reach; an event is all that hangs together by links. A shear wave has
// 1/sqrt(2 (1 + nu)) of the speed of a longitudinal wave in a bar, so twice its time is 3.1 times the bar wave's at nu = 0.2, rounded up
// to 4. In other words: a crack that runs at c/4 or faster, in steps within the reach, is one event, and one that advances by a single
// diameter at a time may be 2.5 times slower. (YADE's rule has the same form: five mean diameters and once the time of a P wave over them.)
//
// Limits. A test in the computer is loaded thousands of times faster than in the laboratory while its waves run at their true speed: near
// the peak independent cracks overlap in time and grow together into few large events. Mass scaling slows the waves of the scaled spheres.
// The energy is that dissipated by the bonds' damage, as a measure of size; what is radiated is another share of what the specimen
// releases. So magnitudes compare events with each other, not with a sensor's.
#pragma once

#include <optional>
#include <vector>

#include "lab/series/outcome.hpp"
#include "lab/test_run.hpp"
#include "reports/record/record.hpp"

namespace proveta {

/// What belongs to one event. All positive.
struct AcousticRule {
    double diameter;       ///< mean diameter of the spheres, m
    double wave_speed;     ///< c = sqrt(E / rho), m/s
    double reach = 2.5;    ///< in diameters
    double patience = 4.0; ///< in travel times over the reach

    [[nodiscard]] double distance() const { return reach * diameter; }                         ///< m
    [[nodiscard]] double duration() const { return patience * reach * diameter / wave_speed; } ///< s
};

/// Failures that belong together.
struct AcousticEvent {
    double start;                    ///< time of the first failure, s
    double duration;                 ///< to the last, s; 0 for a single failure
    double axial_strain;             ///< nominal, at the start
    Vec3 centre;                     ///< mean position weighted by energy, m
    std::size_t bonds;               ///< how many failed
    double tension;                  ///< share of them that failed in tension
    double energy;                   ///< sum over the bonds, J
    std::optional<double> magnitude; ///< M = (2/3) (log10 E - 4.8), E in J; empty without energy
    double radius;                   ///< of gyration about the centre, weighted by energy, m
};

/// Energy magnitude (B. Gutenberg, C. F. Richter, Bull. Seismol. Soc. Am. 46 (1956) 105: log10 E = 4.8 + 1.5 M, E in J).
std::optional<double> energy_magnitude(double energy);

/// Clusters, by time of their first failure. The same failures give the same events, bit for bit; their order matters only among those of
/// equal time, for the last bits of sums. Takes n log n for n failures as long as the number within a reach of each other is bounded, which
/// it is because a bond fails once. Throws std::invalid_argument for a rule without reach or duration.
std::vector<AcousticEvent> acoustic_events(const std::vector<FailureEvent>& failures, const AcousticRule& rule);

/// acoustic.csv.
report::Table acoustic_table(const std::vector<AcousticEvent>& events, const AcousticRule& rule);

/// Gutenberg and Richter's law log10 N(>= M) = a - b M.
struct MagnitudeLaw {
    double b;
    double error;        ///< standard error of b
    double completeness; ///< magnitude from which on the law is taken to hold
    std::size_t events;  ///< of at least this magnitude
};

/// b by maximum likelihood, b = log10(e) / (mean M - M_c) over M >= M_c (K. Aki, Bull. Earthq. Res. Inst. 43 (1965) 237), with its standard
/// error ln(10) b^2 sqrt(sum (M - mean)^2 / (n (n - 1))) (Y. Shi, B. A. Bolt, Bull. Seismol. Soc. Am. 72 (1982) 1677), which for magnitudes
/// that follow the law is b / sqrt(n). M_c is the lower edge of the fullest bin of a histogram with bins of 0.1 centred on tenths: where
/// the histogram bends gently this is known to be too low by about 0.2 (J. Woessner, S. Wiemer, Bull. Seismol. Soc. Am. 95 (2005) 684), and
/// b with it. None with fewer than 50 magnitudes from M_c on, or when these do not differ.
Outcome<MagnitudeLaw> magnitude_law(const std::vector<double>& magnitudes);

/// Magnitudes of the events that have one.
std::vector<double> magnitudes_of(const std::vector<AcousticEvent>& events);

/// Number of events, the largest, energy, b-value with error and completeness; what could not be found says why in `formula`.
std::vector<report::Scalar> acoustic_results(const std::vector<AcousticEvent>& events);

/// Shares of the number of events and of their energy up to a strain, over axial strain in %.
report::Plot acoustic_activity_plot(const std::vector<AcousticEvent>& events);

/// log10 of the number of events of at least a magnitude, over magnitude, with the law where there is one.
report::Plot magnitude_plot(const std::vector<AcousticEvent>& events);

} // namespace proveta
