// What is measured on a specimen in the press, the same for every test.
#pragma once

#include <vector>

#include "lab/bench.hpp"
#include "lab/gauges.hpp"
#include "reports/record/record.hpp"

namespace proveta {

/// Gauges on the specimen, made once and read at every sample. Strains and stresses are compression-positive. Spheres that have come off
/// the specimen (`detached_spheres`) are left out of all averages.
class Instruments {
  public:
    explicit Instruments(const Bench& bench);

    /// Columns of curve.csv and of energy.csv.
    [[nodiscard]] report::Table empty_curve() const;
    static report::Table empty_energy();
    /// The columns of every test's curve. area_now: stress is force over the mean section at the time.
    static std::vector<report::Column> curve_columns(bool area_now);

    /// What the run knows of where it stands.
    struct Mark {
        double stage = 0.0;
        double phase = 0.0;
        double pressure = 0.0; ///< on the side, Pa
    };

    /// Adds a row to each table. The model's last step must have measured.
    void sample(const Bench& bench, const Mark& mark, report::Table& curve, report::Table& energy);

    /// Strain of the girth at mid-height from the lateral skin, positive when the specimen gets thinner; cheap.
    [[nodiscard]] double girth_strain(const Model& model) const;

    /// Names what later samples depend on, each name after `prefix`.
    void visit_state(const std::string& prefix, StateVisitor& visit);

    /// Counts a failed bond.
    void count(FailureMode mode) { ++(mode == FailureMode::tension ? broken_tension_ : broken_shear_); }

    /// Mean small strain of an inner region, compression positive: the symmetric slope of the displacements of its spheres.
    [[nodiscard]] Mat3 mean_strain(const Model& model) const;

    /// Love-Weber stress averaged over an inner region, Pa: (1/V) sum of force times branch, each branch with its fraction inside.
    [[nodiscard]] Mat3 mean_stress(const Model& model, const Shape::Region& region) const;

    /// Mean stress on the side from the forces that act there, Pa: on a ring, from a membrane or from a pressure; 0 where nothing does.
    [[nodiscard]] static double lateral_stress(const Model& model, const Press& press);

    /// Area that stress is force over now, m2.
    [[nodiscard]] static double area(const Model& model, const Press& press);

  private:
    double height_ = 0.0;
    bool area_now_ = false;
    double volume_ = 0.0;       // inside the membrane at the start, m3; 0: there is none
    double girth_radius_ = 0.0; // of the membrane at mid-height at the start, m
    Gauges gauges_;
    Shape::Region inner_;
    Shape::Region middle_;            // the whole section over the middle of the height
    std::vector<std::size_t> inside_; // spheres of the inner region
    std::vector<std::uint8_t> off_;   // detached spheres
    std::int64_t off_at_ = 0;         // number of failed bonds that it was found for
    std::int64_t broken_tension_ = 0;
    std::int64_t broken_shear_ = 0;
};

} // namespace proveta
