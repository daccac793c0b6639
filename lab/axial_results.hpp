// Presses and derived results that compression tests along the axis share.
#pragma once

#include <vector>

#include "core/particles/spheres.hpp"
#include "lab/derived.hpp"
#include "lab/protocols/protocol.hpp"

namespace proveta {

/// Two platens across the axis that cap the specimen's ends. stiffness: factor on their contacts' stiffness.
Press axial_press(const Spheres& spheres, const Shape& shape, double friction, double stiffness);

/// E, nu and its relatives from the gauges between shares of the peak deviator, toe of the curve, softening: ASTM D7012, EN 12390-13.
std::vector<report::Scalar> elastic_results(const Loading& loading);
std::vector<report::Scalar> softening_results(const Loading& loading);

/// Of each unloading its modulus, a secant from the largest strain to where the platens turned again, and the strains there.
std::vector<report::Scalar> cycle_results(const report::Table& curve, double sense);
/// What cycle n gives, without values.
std::vector<report::Scalar> loop_results(std::size_t n);

/// Work of the platens, what cracking took of it, and the cracks' area.
std::vector<report::Scalar> energy_results(const Measured& measured);

/// Peak of a list if the list has fallen 5 % below it since, or else empty.
std::optional<double> peak_if_passed(const std::vector<double>& y);

/// The loading up to where the deviator comes back to a peak from which it had fallen by 5 %, so that a specimen which breaks and then
/// hardens again has the peak at which it broke. Peaks below half of the largest deviator are ripples of the beginning.
Loading until_recovery(const Loading& loading);

/// How many samples of the loading are elastic: until damage, plastic strain and sliding have taken a hundredth of the work.
std::size_t elastic_samples(const Measured& measured, const Loading& loading);

/// Stress over strain by platens, gauge and girth, the peak marked.
PlotSpec stress_strain_plot(const std::string& title, const std::string& stress);

} // namespace proveta
