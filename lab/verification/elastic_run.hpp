// An explicit test on an unbreakable specimen, for what it says of elasticity.
#pragma once

#include "lab/test_run.hpp"

namespace proveta::verification {

/// The readings of a test on an unbreakable specimen, as slopes over the mean platen stress of its second half.
class ElasticRun {
  public:
    /// Runs the test at once. material: what else the deck's material says. Throws InputError.
    ElasticRun(const char* test, input::Json specimen, input::Json loading, const input::Json& material = input::Json::object());

    /// d(column) / d(axial stress)
    [[nodiscard]] double of(const char* column) const;
    [[nodiscard]] double lateral_stress() const { return 0.5 * (of("inner_stress_xx") + of("inner_stress_yy")); }
    [[nodiscard]] double lateral_strain() const { return 0.5 * (of("inner_strain_xx") + of("inner_strain_yy")); }

    /// Platen stress over the middle gauge's strain, Pa, and minus the girth's over it.
    [[nodiscard]] double young_modulus() const { return 1.0 / of("gauge_axial_strain"); }
    [[nodiscard]] double poisson_ratio() const { return -of("circumferential_strain") / of("gauge_axial_strain"); }

    /// Worst of |a / b - 1| from a tenth of b's last value on.
    [[nodiscard]] double worst_ratio(const char* a, const char* b) const;

    [[nodiscard]] const std::vector<MaterialCalibration>& calibrations() const { return calibrations_; }
    /// Largest residual of the ledger over its work.
    [[nodiscard]] double ledger_residual() const { return ledger_residual_; }

  private:
    TestData data_;
    std::vector<MaterialCalibration> calibrations_;
    double ledger_residual_ = 0.0;
};

} // namespace proveta::verification
