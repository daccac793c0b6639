#include "lab/calibrate/plausible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lab/derived.hpp"

namespace proveta {

std::string plain(const std::string& quantity) {
    std::string out = quantity;
    std::replace(out.begin(), out.end(), '_', ' ');
    return out;
}

bool is_stress(const std::string& quantity) { return quantity.ends_with("stress"); }

std::optional<double> Plausible::factor_for(double size) const {
    const auto fits = std::find_if(factors.begin(), factors.end(), [&](double f) { return holds(f * size); });
    return fits == factors.end() ? std::nullopt : std::optional(*fits);
}

namespace {

// The value farthest from zero, with its sign.
double largest(const std::vector<double>& v) {
    return *std::max_element(v.begin(), v.end(), [](double a, double b) { return std::fabs(a) < std::fabs(b); });
}

Plausible plausible(const std::string& quantity, const std::string& test) {
    if (is_stress(quantity)) {
        return {test == "granular-triaxial" ? 1e2 : 1e4, 1e10, {1e6, 1e3, 1e9, 1e-3, 1e-6}};
    }
    const double most = test == "granular-triaxial"                       ? 0.5
                        : test == "direct-tension" || test == "brazilian" ? 0.02
                        : test == "ucs"                                   ? 0.05
                                                                          : 0.2;
    return {1e-7, most, {1e-2, 1e-6, 1e-3}};
}

void refuse(const std::string& what, char key, double now, double times) {
    throw std::runtime_error(fmt::format("{}: \"{}_factor\": {:.6g} would make it so", what, key, now * times));
}

// Sign and size of one quantity.
void check_quantity(const std::vector<double>& v, const std::string& quantity, const std::string& test, char key, double now) {
    const double most = largest(v);
    const bool girth = quantity == "circumferential_strain";
    const bool either = quantity == "volumetric_strain"; // smaller first, and larger where it dilates
    const double wanted = girth && test != "direct-tension" ? -1.0 : 1.0;
    if (!either && most * wanted < 0.0) {
        refuse(fmt::format("{} goes to {:.4g} while in a {} test it is {} ({})", plain(quantity), most, test,
                           wanted > 0.0 ? "positive" : "negative",
                           girth ? "the specimen gets thicker, and strain is positive where it gets thinner"
                                 : "strain and stress are positive in the sense of the test"),
               key, now, -1.0);
    }
    const Plausible range = plausible(quantity, test);
    const double size = std::fabs(most);
    if (size > 0.0 && !range.holds(size)) {
        const char* unit = is_stress(quantity) ? " Pa" : "";
        if (const auto factor = range.factor_for(size)) {
            refuse(fmt::format("{} goes to {:.4g}{}, while a {} test's lies between {:.4g} and {:.4g}", plain(quantity), most, unit, test,
                               range.low, range.high),
                   key, now, *factor);
        }
        throw std::runtime_error(fmt::format("{} goes to {:.4g}{}, which is none of a material", plain(quantity), most, unit));
    }
}

// Moduli of a test's material, Pa.
Plausible modulus(const std::string& test) { return {test == "granular-triaxial" ? 1e5 : 1e6, 300e9, {1e9, 1e6, 1e3, 1e-3}}; }

// Stress over strain: its slope is a modulus. young: the card's, 0: unknown.
std::string check_modulus(const SampledCurve& c, const TargetInput& t, const std::string& test, double young) {
    if (!is_stress(t.y) || (t.x != "axial_strain" && t.x != "gauge_strain")) {
        return "";
    }
    const auto slope = slope_between(c.x, c.y, 0.1, 1.0 / 3.0);
    const Plausible range = modulus(test);
    if (!slope || range.holds(*slope)) {
        constexpr double alike = 30.0; // a card may be far from the material yet; thousands are units
        if (slope && young > 0.0 && (*slope > alike * young || *slope < young / alike)) {
            return fmt::format("a modulus of {:.3g} GPa between 10 % and 33 % of the peak, {:.2g} times the {:.3g} GPa of "
                               "the deck's card: are the units right (kPa or Pa, per cent or fraction)?",
                               1e-9 * *slope, *slope / young, 1e-9 * young);
        }
        return "";
    }
    const std::string what = fmt::format("a modulus of {:.4g} Pa between 10 % and 33 % of the peak, while materials have {:.4g} to {:.4g}",
                                         *slope, range.low, range.high);
    for (const double f : {1e-2, 1e-6, 1e-3}) { // of the strain, by which the slope is divided
        if (range.holds(*slope / f)) {
            refuse(what, 'x', t.x_factor, f);
        }
    }
    throw std::runtime_error(what);
}

// Strains where stresses should be, and the other way round.
void check_swapped(const SampledCurve& c, const TargetInput& t, const std::string& test) {
    if (is_stress(t.y) && largest(c.x) > plausible(t.x, test).high && largest(c.y) < plausible(t.x, test).high) {
        throw std::runtime_error(fmt::format("{} goes to {:.4g} and {} to {:.4g} Pa: is x_column the stress and y_column the strain?",
                                             plain(t.x), largest(c.x), plain(t.y), largest(c.y)));
    }
}

} // namespace

std::optional<Plausible> plausible_result(const report::Scalar& result, const std::string& test) {
    const auto named = [&](const char* part) { return result.name.find(part) != std::string::npos; };
    if (result.unit == "Pa" && !named("slope")) {
        return named("modulus") ? modulus(test) : plausible("total_stress", test);
    }
    if (result.unit.empty() && (named("_strain") || named("strain_")) && !named("ratio")) {
        return plausible("axial_strain", test);
    }
    if (result.name == "poisson_ratio") {
        return Plausible{0.0, 0.5, {1e-2}};
    }
    return std::nullopt;
}

std::string check_plausible(const SampledCurve& curve, const TargetInput& t, const std::string& test, double young) {
    check_swapped(curve, t, test);
    check_quantity(curve.x, t.x, test, 'x', t.x_factor);
    check_quantity(curve.y, t.y, test, 'y', t.y_factor);
    return check_modulus(curve, t, test, young);
}

} // namespace proveta
