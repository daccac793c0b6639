#include "lab/elastic/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/elastic/pressable.hpp"
#include "lab/elastic/uniaxial.hpp"

namespace proveta {

namespace {

constexpr double tolerance = 2e-4; // of nu
// Lowest k_t / k_n. Where the averaged part can do the rest, bonds keep enough shear stiffness to carry their shear strength at small
// slips.
constexpr double lowest_beside_averaged = 0.15;
constexpr double lowest_alone = 0.02; // of k_t / k_n: below, rows of spheres roll like a mechanism
constexpr double highest_shear = 5.0;
constexpr int most_solves = 12;
// Young's modulus by platen travel over that by the gauges: 1.01 to 1.05 in packings that were made between walls, 0.1 where the platens
// touch single spheres. Where the ends give way a test shows neither E nor nu.
constexpr double least_by_travel = 0.6;
constexpr double most_by_travel = 1.6;
// The factor a: 0.9 in packings with 20 bonds a sphere, 1.3 to 1.7 with 8 to 14; ten times less or more is no specimen's.
constexpr double smallest_factor = 0.1;
constexpr double largest_factor = 20.0;

// Solves for a = 1, each from the solution before.
class Trials {
  public:
    Trials(const Shape& shape, const Spheres& spheres, const Material& material, const std::function<Bonds(const Material&)>& network)
        : shape_(shape), spheres_(spheres), material_(material), network_(network) {
        material_.normal_factor = 1.0;
    }

    // shear: k_t / k_n; averaged: lambda / E.
    const UniaxialReading& operator()(double shear, double averaged) {
        material_.shear_factor = shear * 2.0 * (1.0 + material_.poisson_ratio);
        material_.averaged_factor = averaged;
        reading_ = press_uniaxially(shape_, spheres_, {material_}, network_(material_), false, solves_ > 0 ? &reading_.solution : nullptr);
        ++solves_;
        if (!(reading_.young_modulus > 0.0) || !std::isfinite(reading_.poisson_ratio)) {
            throw NotCalibrated("the gauges of this specimen show no strain, or one of the wrong sign");
        }
        return reading_;
    }

    [[nodiscard]] const Material& material() const { return material_; }
    [[nodiscard]] const UniaxialReading& last() const { return reading_; }
    [[nodiscard]] int solves() const { return solves_; }

  private:
    const Shape& shape_;
    const Spheres& spheres_;
    Material material_;
    const std::function<Bonds(const Material&)>& network_;
    UniaxialReading reading_;
    int solves_ = 0;
};

// k_t / k_n that gives nu, by secants from what an affine network would need, nu = (1 - k) / (4 + k). At a bound it stops there.
void meet_by_shear(Trials& trial, double nu, double lowest) {
    double k = std::clamp((1.0 - 4.0 * nu) / (1.0 + nu), lowest, highest_shear);
    double error = trial(k, 0.0).poisson_ratio - nu;
    double slope = -5.0 / ((4.0 + k) * (4.0 + k));
    while (std::fabs(error) > tolerance && trial.solves() < most_solves) {
        const double next = std::clamp(k - error / slope, std::max(lowest, 0.3 * k), std::min(highest_shear, 3.0 * k + 0.1));
        if (next == k) {
            return;
        }
        const double before = error;
        error = trial(next, 0.0).poisson_ratio - nu;
        const double found = (error - before) / (next - k);
        slope = found < -1e-3 ? found : slope;
        k = next;
    }
}

// lambda that gives nu at the k_t / k_n of (5.17). Isotropic solids tell how much more bulk modulus that takes; the network takes it
// nearly so, hence few corrections.
void meet_by_average(Trials& trial, double nu) {
    const double k = 1.0 / (2.0 * (1.0 + nu));
    const double young = trial.material().young_modulus;
    double lambda = 0.0;
    trial(k, lambda);
    for (double gain = 1.0; std::fabs(trial.last().poisson_ratio - nu) > tolerance && trial.solves() < 2 * most_solves;) {
        const double e = trial.last().young_modulus;
        const double found = trial.last().poisson_ratio;
        const double shear = e / (2.0 * (1.0 + found));
        const double bulk_by = 2.0 * shear / 3.0;
        const auto bulk = [&](double ratio) { return bulk_by * (1.0 + ratio) / (1.0 - 2.0 * ratio); };
        if (found >= 0.5) {
            throw NotCalibrated(fmt::format("with the averaged part the specimen shows nu = {:.3f}", found));
        }
        const double missing = (bulk(nu) - bulk(found)) / young;
        const double before = bulk(found);
        trial(k, lambda + gain * missing);
        lambda += gain * missing;
        // How much of what was added came: the skin's spheres take it up only in part.
        const double came = trial.last().poisson_ratio < 0.5 ? (bulk(trial.last().poisson_ratio) - before) / (gain * missing * young) : 2.0;
        gain = std::clamp(1.0 / came, 0.3, 3.0);
    }
}

} // namespace

ElasticCalibration calibrate_elasticity(const Shape& shape, const Spheres& spheres, const Material& material, bool averaged,
                                        const std::function<Bonds(const Material&)>& network) {
    const double nu = material.poisson_ratio;
    Trials trial(shape, spheres, material, network);
    ElasticCalibration out;
    out.wanted_poisson_ratio = nu;
    const auto met = [&] { return std::fabs(trial.last().poisson_ratio - nu) <= tolerance; };
    if (const auto why = not_pressable(shape, spheres, network(material))) {
        throw NotCalibrated(*why);
    }
    try {
        meet_by_shear(trial, nu, averaged ? lowest_beside_averaged : lowest_alone);
        if (!met()) {
            out.furthest = trial.last().poisson_ratio;
            if (averaged && nu > *out.furthest) {
                meet_by_average(trial, nu);
            }
        }
        out.in_reach = met();
    } catch (const NotSolvable& e) {
        throw NotCalibrated(e.what());
    } catch (const std::invalid_argument& e) {
        throw NotCalibrated(e.what());
    }
    const double by_travel = trial.last().travel_modulus / trial.last().young_modulus;
    if (!(by_travel > least_by_travel && by_travel < most_by_travel)) {
        throw NotCalibrated(fmt::format("{}, and they press it in {:.2g} times as much as its middle: its ends give way",
                                        touched_spheres(shape, spheres), 1.0 / by_travel));
    }
    if (!(trial.last().poisson_ratio > -1.0 && trial.last().poisson_ratio < 0.5)) {
        throw NotCalibrated(fmt::format("its gauges show nu = {:.3g}, which no solid body has", trial.last().poisson_ratio));
    }
    out.factors.normal_factor = material.young_modulus / trial.last().young_modulus;
    if (out.factors.normal_factor < smallest_factor || out.factors.normal_factor > largest_factor) {
        throw NotCalibrated(fmt::format("{}, and its bonds would have to be {:.3g} times as stiff as solid columns between their spheres, "
                                        "where {:.2g} to {:.2g} times make a specimen",
                                        touched_spheres(shape, spheres), out.factors.normal_factor, smallest_factor, largest_factor));
    }
    out.factors.shear_factor = trial.material().shear_factor * out.factors.normal_factor;
    out.factors.averaged_factor = trial.material().averaged_factor;
    out.young_modulus = material.young_modulus;
    out.poisson_ratio = trial.last().poisson_ratio;
    out.solves = trial.solves();
    return out;
}

std::string text_of(const ElasticCalibration& c) {
    const auto& f = c.factors;
    std::string text = fmt::format("a = {:.4f}, b = {:.4f}", f.normal_factor, f.shear_factor);
    if (f.averaged_factor != 0.0) {
        text += fmt::format(", lambda/(a E) = {:.4f}", f.averaged_factor);
    }
    text += fmt::format(" give E = {:.4g} GPa, nu = {:.4f}", 1e-9 * c.young_modulus, c.poisson_ratio);
    if (!c.in_reach) {
        text += fmt::format("; the card's nu = {:.4g} is out of reach", c.wanted_poisson_ratio);
    } else if (c.furthest) {
        text += fmt::format("; bonds alone reach nu = {:.3f}, the averaged part of the stress the rest", *c.furthest);
    }
    return text;
}

} // namespace proveta
