// Measured curves of triaxial tests, one file a curve (materials/experiments/README.md).
#pragma once

#include <string>
#include <vector>

namespace proveta {

/// A curve as a laboratory measured it. Compression is positive; stresses in Pa.
struct MeasuredCurve {
    double confinement = 0.0;
    bool total = true; ///< axial_stress is the total one, else axial minus lateral
    std::vector<double> axial_strain, lateral_strain, axial_stress;

    [[nodiscard]] bool empty() const { return axial_strain.empty(); } ///< a slot that nobody has filled yet
};

/// True when a file's heading is that of a measured curve: confinement_MPa, axial_strain, lateral_strain, axial_stress_MPa, kind.
bool is_measured_curve(const std::string& file);

/// Reads a measured curve. lateral_strain may be left empty in a row: not a number. Throws std::runtime_error naming file, line and what is
/// wrong: cells that are no numbers, several confinements, a kind that is neither "total" nor "deviatoric", or both.
MeasuredCurve load_measured_curve(const std::string& file);

} // namespace proveta
