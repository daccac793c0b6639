#include "lab/scene/particle_kinds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/contacts/rolling.hpp"
#include "core/motion/stable_step.hpp"
#include "lab/scene/scene_surfaces.hpp"
#include "specimens/grading.hpp"
#include "specimens/memory.hpp"
#include "specimens/stones.hpp"

namespace proveta {

namespace {

void scale(std::vector<double>& values, double factor) {
    std::for_each(values.begin(), values.end(), [=](double& v) { v *= factor; });
}

std::vector<double> sizes_of(const ParticleInput& p, std::uint64_t seed, const Scene& scene, const std::string& path) {
    const auto n = static_cast<std::size_t>(p.count);
    std::vector<double> sizes(n, p.size);
    if (!p.grading.empty()) {
        sizes = graded_radii(n, sieve_curve(p.grading), seed);
        scale(sizes, 2.0);
    } else if (p.deviation > 0.0) {
        try {
            sizes = normal_radii(n, p.deviation, p.smallest, p.largest, seed);
        } catch (const std::invalid_argument&) {
            throw input::InputError(
                {{scene.source, path + "/deviation", fmt::format("{:.4g}", p.deviation),
                  fmt::format("a deviation that sizes between {:.3g} and {:.3g} of the mean can have", p.smallest, p.largest),
                  "widen smallest and largest"}});
        }
        scale(sizes, p.size);
    }
    return sizes;
}

std::vector<ClusterShape> forms_of(const ParticleInput& p, std::uint64_t seed, const Scene& scene, const std::string& path) {
    std::vector<ClusterShape> forms;
    if (p.form == "file") {
        try {
            forms.push_back(form_of(closed_surface(scene, p.file, path + "/file"), static_cast<int>(p.spheres)));
        } catch (const std::invalid_argument& error) {
            throw input::InputError({{scene.source, path + "/file", "\"" + p.file + "\"", "a solid that spheres can fill", error.what()}});
        }
    } else if (p.form == "stone") {
        const StoneKind kind{p.elongation, p.flatness, static_cast<int>(p.facets)};
        for (std::int64_t k = 0; k < std::min(p.forms, p.count); ++k) {
            forms.push_back(form_of(stone_surface(kind, 1000 * seed + static_cast<std::uint64_t>(k)), static_cast<int>(p.spheres)));
        }
    }
    return forms;
}

} // namespace

std::vector<ParticleKind> make_kinds(const Scene& scene) {
    std::vector<ParticleKind> out;
    std::size_t spheres = 0; // of all kinds so far
    for (std::size_t k = 0; k < scene.particles.size(); ++k) {
        const ParticleInput& p = scene.particles[k];
        const std::string path = fmt::format("/particles/{}", k);
        const auto seed = static_cast<std::uint64_t>(scene.seed) * 1000 + k;
        ParticleKind kind;
        kind.material = scene.material(p.material);
        kind.density = scene.materials[static_cast<std::size_t>(kind.material)].material.values.density;
        kind.forms = forms_of(p, seed, scene, path);
        for (const auto& form : kind.forms) {
            kind.reach.push_back(reach_of(form));
        }
        std::size_t of_forms = 0;
        for (const auto& form : kind.forms) {
            of_forms += form.radius.size();
        }
        spheres += static_cast<std::size_t>(p.count) * of_forms / std::max(kind.forms.size(), std::size_t{1});
        spheres += kind.forms.empty() ? static_cast<std::size_t>(p.count) : 0;
        require_memory(spheres, scene.source, path + "/count", fmt::format("{} particles, {} spheres in all so far", p.count, spheres));
        for (const double size : sizes_of(p, seed, scene, path)) {
            kind.plan.push_back({size, kind.forms.empty() ? -1 : static_cast<int>(kind.plan.size() % kind.forms.size())});
        }
        out.push_back(std::move(kind));
    }
    return out;
}

double mean_radius(const std::vector<ParticleKind>& kinds) {
    double sum = 0.0;
    double spheres = 0.0;
    for (const auto& kind : kinds) {
        for (const auto& p : kind.plan) {
            if (p.form < 0) {
                sum += 0.5 * p.size;
                spheres += 1.0;
                continue;
            }
            for (const double r : kind.forms[static_cast<std::size_t>(p.form)].radius) {
                sum += r * p.size;
                spheres += 1.0;
            }
        }
    }
    return sum / spheres;
}

double stable_step(const std::vector<ParticleKind>& kinds, const std::vector<Material>& materials, double largest_overlap) {
    constexpr double neighbours = 12.0;
    constexpr double weight = 2.0; // of a spring that two equal particles share
    double lowest = std::numeric_limits<double>::infinity();
    for (const auto& kind : kinds) {
        const Material& m = materials[static_cast<std::size_t>(kind.material)];
        const LoosePair pair = loose_pair(m, m);
        const auto least = std::min_element(kind.plan.begin(), kind.plan.end(), [](auto& a, auto& b) { return a.size < b.size; });
        for (std::size_t f = 0; f < std::max<std::size_t>(1, kind.forms.size()); ++f) {
            double radius = 0.5 * least->size;
            double lever = radius;
            double mass = kind.density * std::numbers::pi / 6.0 * std::pow(least->size, 3);
            double inertia = 0.4 * mass * radius * radius;
            if (!kind.forms.empty()) {
                const ClusterShape& form = kind.forms[f];
                radius = least->size * *std::max_element(form.radius.begin(), form.radius.end());
                lever = least->size * kind.reach[f];
                inertia = kind.density * form.inertia.minCoeff() * std::pow(least->size, 5);
            }
            const LooseBody body{radius, mass, inertia};
            const LooseContact contact = loose_contact(pair, body, body, std::numbers::pi * radius * radius);
            const Stiffness s = stiffness_at(contact, largest_overlap * radius);
            const auto demand = [&](double normal, double tangential) {
                const double turning = kind.forms.empty() ? tangential : std::max(normal, tangential);
                return neighbours * weight *
                       std::max((normal + 2.0 * tangential) / 3.0 / mass, 2.0 / 3.0 * turning * lever * lever / inertia);
            };
            const double rolling =
                contact.rolling_arm > 0.0 ? neighbours * weight * 2.0 * rolling::share * contact.reduced_inertia / inertia : 0.0;
            lowest = std::min(lowest, SphereDemand{demand(s.k_n, s.k_t), demand(s.c_n, s.c_t), std::max(4.0 - rolling, 0.04)}.step());
        }
    }
    return lowest;
}

} // namespace proveta
