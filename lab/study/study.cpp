#include "lab/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "lab/series/expand.hpp"
#include "lab/study/variation.hpp"

namespace proveta {

using input::Json;

namespace {

constexpr StudyKind kinds[] = {StudyKind::rate, StudyKind::step, StudyKind::size};

double length_along_load(const Deck& deck) {
    const Shape shape =
        deck.specimen.file.empty() ? shape_of(deck.specimen) : obtain_specimen(deck.specimen, deck.folder, deck.source).shape;
    return deck.test == "brazilian" ? shape.lateral_size() : shape.height;
}

// Distance from sphere to sphere, on the mean, m.
double spacing(const Deck& deck) {
    const Shape shape = shape_of(deck.specimen);
    const double room = shape.volume() / static_cast<double>(deck.specimen.spheres);
    return shape.planar() ? std::sqrt(room) : std::cbrt(room);
}

// Values about the deck's own, from the coarsest to the finest.
std::vector<double> usual_values(StudyKind kind, const Deck& deck, const Json& json) {
    const auto multiples = [](double of, std::initializer_list<double> factors) {
        std::vector<double> out;
        for (const double f : factors) {
            out.push_back(of * f);
        }
        return out;
    };
    if (kind == StudyKind::size) {
        auto out = multiples(static_cast<double>(deck.specimen.spheres), {0.1, 0.25, 0.5, 1.0});
        std::transform(out.begin(), out.end(), out.begin(), [](double v) { return std::round(v); });
        return out;
    }
    if (kind == StudyKind::step) {
        return {0.9, 0.6, 0.3, 0.15};
    }
    const auto pointer = Json::json_pointer("/loading/rate");
    if (json.contains(pointer) && json[pointer].is_number()) {
        return multiples(json[pointer].get<double>(), {4.0, 2.0, 1.0, 0.5});
    }
    return multiples(length_along_load(deck), {2.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0, 1.0 / 12.0}); // a second
}

Json as_json(StudyKind kind, double value) {
    return kind == StudyKind::size ? Json(static_cast<std::int64_t>(std::llround(value))) : Json(value);
}

// The value that a member of a study has; nothing where it has none.
std::optional<double> value_of(StudyKind kind, const Deck& deck) {
    const Json::json_pointer at(fmt::format("/{}/{}", variation(kind).section, variation(kind).key));
    const Json json = resolved(deck);
    return json.contains(at) && json[at].is_number() ? std::optional(json[at].get<double>()) : std::nullopt;
}

} // namespace

Plan plan_study(const StudyRequest& request) {
    const Variation& varied = variation(request.kind);
    Json base = input::load_json(request.deck);
    apply_settings(base, request.settings);
    input::Problems problems;
    if (has_lists(base) || base.contains("proveta_manifest") || base.contains("proveta_series_manifest")) {
        throw input::InputError({{request.deck, "", "a series or a manifest", "the deck of one test", "a study makes its own series"}});
    }
    const Deck own = read_deck(base, request.deck);
    if (!own.specimen.file.empty() && (request.kind == StudyKind::size || request.seeds > 1)) {
        problems.push_back({request.deck, "/specimen/file", "\"" + own.specimen.file + "\"", "a recipe, of which specimens can be made",
                            "a stored specimen has one size and one packing"});
    }
    if (request.kind == StudyKind::step && own.numerics.time_step.word.empty()) {
        problems.push_back({request.deck, "/numerics/time_step", fmt::format("{:.6g} s", own.numerics.time_step.number),
                            "\"auto\", or no such key: the study sets the step, as a share of the stable one",
                            "--set numerics.time_step=auto"});
    }
    const auto values = request.values.empty() ? usual_values(request.kind, own, resolved(own)) : request.values;
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (std::count(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(k), values[k]) > 0) {
            problems.push_back({"--values", "", fmt::format("{:.6g} twice", values[k]), "values that differ", ""});
        }
    }
    if (values.size() < 2) {
        problems.push_back({"--values", "", fmt::format("{} of them", values.size()), "at least two values to compare", ""});
    }
    Plan plan;
    plan.series = true;
    plan.study = varied.name;
    plan.title = fmt::format("{}: a study of the {}", own.title, varied.title);
    std::vector<MemberProblem> found;
    for (const double value : values) {
        for (int s = 0; s < request.seeds; ++s) {
            Json json = base;
            json[varied.section][varied.key] = as_json(request.kind, value);
            if (request.seeds > 1) {
                json["specimen"]["seed"] = own.specimen.seed + s;
            }
            try {
                Deck deck = read_deck(json, request.deck);
                const std::string name = fmt::format("{}_{:.6g}", varied.key, value);
                plan.members.push_back({request.seeds > 1 ? fmt::format("{}_seed_{}", name, deck.specimen.seed) : name, std::move(deck)});
            } catch (const input::InputError& error) {
                for (const auto& problem : error.problems) {
                    found.push_back({problem, {}});
                }
            }
        }
    }
    for (const auto& problem : merged(found)) {
        problems.push_back(problem);
    }
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
    return plan;
}

SeriesStudy study_of(const Plan& plan) {
    const auto* kind = std::find_if(std::begin(kinds), std::end(kinds), [&](StudyKind k) { return plan.study == variation(k).name; });
    if (kind == std::end(kinds)) {
        return {};
    }
    Study study;
    study.kind = *kind;
    for (const auto& member : plan.members) {
        const auto value = value_of(study.kind, member.deck);
        if (!value) {
            return {};
        }
        study.values.push_back(*value);
        study.x.push_back(study.kind == StudyKind::size ? spacing(member.deck) : *value);
    }
    return [study](const std::vector<MemberResult>& members) { return evaluate_study(study, members); };
}

} // namespace proveta
