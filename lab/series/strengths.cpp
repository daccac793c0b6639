#include "lab/series/strengths.hpp"

#include <set>
#include <tuple>

#include "lab/series/statistics.hpp"

namespace proveta {

namespace {

double pressure_of(const MemberResult& m) { return m.value("confining_pressure").value_or(0.0); }

// Values of a result among complete members; unconfined: only of those without pressure on the side.
std::vector<double> values_of(const std::vector<MemberResult>& members, const char* name, bool unconfined) {
    std::vector<double> out;
    for (const auto& m : members) {
        const auto value = m.value(name);
        if (m.complete() && value && (!unconfined || pressure_of(m) == 0.0)) {
            out.push_back(*value);
        }
    }
    return out;
}

} // namespace

std::optional<StrengthEnvelope> envelope_of(const std::vector<MemberResult>& members) {
    std::vector<StrengthPoint> points;
    std::set<double> pressures;
    std::set<std::pair<double, double>> bonds; // tau_f, mu_s
    for (const auto& m : members) {
        if (!m.complete()) {
            continue;
        }
        if (const auto strength = m.value("strength")) {
            points.push_back({pressure_of(m), *strength});
            pressures.insert(pressure_of(m));
            const Card& card = m.member->deck.material.values;
            if (const auto* law = std::get_if<Dempack::Parameters>(&card.bond)) {
                bonds.insert({law->tau_f * card.strength_factor, law->mu_s});
            }
        }
        if (const auto tensile = m.value("tensile_strength")) {
            points.push_back({-*tensile, 0.0});
        }
        if (const auto splitting = m.value("splitting_strength")) {
            points.push_back({-*splitting, 3.0 * *splitting});
        }
    }
    if (pressures.size() < 2) {
        return std::nullopt;
    }
    StrengthEnvelope envelope = strength_envelope(std::move(points));
    if (bonds.size() == 1) {
        envelope.thesis = thesis_line(bonds.begin()->first, bonds.begin()->second);
    }
    if (const auto unconfined = values_of(members, "strength", true); !unconfined.empty()) {
        envelope.fc = sample_of(unconfined).mean;
    }
    return envelope;
}

std::vector<report::Scalar> strength_ratios(const std::vector<MemberResult>& members) {
    const auto unconfined = values_of(members, "strength", true);
    const auto splitting = values_of(members, "splitting_strength", false);
    const auto tensile = values_of(members, "tensile_strength", false);
    std::vector<report::Scalar> out;
    const auto add = [&](const char* name, const char* title, const std::vector<double>& over, const std::vector<double>& under) {
        const double divisor = sample_of(under).mean;
        if (!over.empty() && divisor > 0.0) {
            out.push_back({name, title, sample_of(over).mean / divisor, "", "of the means over the complete tests of the series"});
        }
    };
    add("compressive_to_splitting", "Unconfined compressive over splitting strength", unconfined, splitting);
    add("compressive_to_tensile", "Unconfined compressive over direct tensile strength", unconfined, tensile);
    add("splitting_to_tensile", "Splitting over direct tensile strength", splitting, tensile);
    return out;
}

} // namespace proveta
