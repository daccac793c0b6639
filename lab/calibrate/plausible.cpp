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
// factor: that makes the size one that can be.
void check_quantity(const std::vector<double>& v, const std::string& quantity, const std::string& test, char key, double now,
                    const std::optional<double>& factor) {
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
        if (factor) {
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

// The factor that makes strains ones that can be, of which the modulus is nearest to the card's where stresses go over them.
std::optional<double> factor_of_strain(const SampledCurve& c, const TargetInput& t, const Plausible& range, double young) {
    std::optional<double> best = range.factor_for(std::fabs(largest(c.x)));
    const auto slope = is_stress(t.y) ? slope_between(c.x, c.y, 0.1, 1.0 / 3.0) : std::nullopt;
    if (!slope || !(*slope > 0.0) || young <= 0.0) {
        return best;
    }
    const auto off = [&](double f) { return std::fabs(std::log(*slope / f / young)); };
    for (const double f : range.factors) {
        if (best && range.holds(f * std::fabs(largest(c.x))) && off(f) < off(*best)) {
            best = f;
        }
    }
    return best;
}

// One value that lies far beyond all others is a reader's "no value" or a spike, and no unit.
void refuse_outlier(const std::vector<double>& v, const std::string& quantity) {
    constexpr double far = 20.0;
    std::vector<double> sizes;
    for (const double x : v) {
        sizes.push_back(std::fabs(x));
    }
    const auto worst = static_cast<std::size_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    std::vector<double> rest = sizes;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(worst));
    if (rest.size() < 5) {
        return;
    }
    const double next = *std::max_element(rest.begin(), rest.end());
    if (next > 0.0 && sizes[worst] > far * next) {
        throw std::runtime_error(
            fmt::format("{} is {:.6g} in point {} and at most {:.4g} in all others: a missing value, or a spike? Leave its "
                        "cell empty",
                        plain(quantity), v[worst], worst + 1, next));
    }
}

// A curve that begins away from the origin, where a test begins.
std::string begins_elsewhere(const SampledCurve& c, const TargetInput& t) {
    const double x = std::fabs(c.x.front() / largest(c.x));
    const double y = std::fabs(c.y.front() / largest(c.y));
    constexpr double near = 0.1;
    if (!is_stress(t.y) || (x <= near && y <= near)) {
        return "";
    }
    return fmt::format("the curve begins at {} {:.4g} and {} {:.4g} MPa, where a test begins at 0 and 0: \"x_offset\" and a stress without "
                       "the load that it began under make it so",
                       plain(t.x), c.x.front(), plain(t.y), 1e-6 * c.y.front());
}

// Strains where stresses should be, and the other way round.
void check_swapped(const SampledCurve& c, const TargetInput& t, const std::string& test) {
    const double strain = plausible(t.x, test).high;
    if (is_stress(t.y) && largest(c.x) > strain && std::min(largest(c.y), largest(c.y) / t.y_factor) < strain) {
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
    refuse_outlier(curve.x, t.x);
    refuse_outlier(curve.y, t.y);
    check_quantity(curve.x, t.x, test, 'x', t.x_factor, factor_of_strain(curve, t, plausible(t.x, test), young));
    check_quantity(curve.y, t.y, test, 'y', t.y_factor, plausible(t.y, test).factor_for(std::fabs(largest(curve.y))));
    const std::string modulus = check_modulus(curve, t, test, young);
    const std::string start = begins_elsewhere(curve, t);
    return modulus.empty() || start.empty() ? modulus + start : modulus + "; " + start;
}

} // namespace proveta
