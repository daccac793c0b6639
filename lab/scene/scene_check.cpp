#include "lab/scene/scene_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/input/suggest.hpp"
#include "lab/scene/scene_bodies.hpp"

namespace proveta {

namespace {

class Check {
  public:
    Check(const Scene& scene, input::Problems& problems) : scene_(scene), problems_(problems) {
        for (const auto& m : scene.materials) {
            names_.push_back(m.name);
        }
    }

    void all() {
        if (scene_.materials.empty()) {
            say("/materials", "none", "at least one: {\"name\": \"glass\", \"material\": {\"card\": \"custom\", ...}}");
        }
        if (scene_.particles.empty()) {
            say("/particles", "none", "at least one kind of particles");
        }
        for (std::size_t k = 0; k < scene_.materials.size(); ++k) {
            check_card(scene_.materials[k].material.values, scene_.source, fmt::format("/materials/{}/material", k), problems_);
        }
        unique("materials", scene_.materials);
        unique("surfaces", scene_.surfaces);
        unique("bodies", scene_.bodies);
        for (std::size_t k = 0; k < scene_.bodies.size(); ++k) {
            const std::string& name = scene_.bodies[k].name;
            if (std::any_of(scene_.surfaces.begin(), scene_.surfaces.end(), [&](const auto& s) { return s.name == name; })) {
                say(fmt::format("/bodies/{}/name", k), "\"" + name + "\", which a surface has", "a name of its own");
            }
        }
        unique("particles", scene_.particles);
        unique("outlets", scene_.outlets);
        unique("measures", scene_.measures);
        for (std::size_t k = 0; k < scene_.surfaces.size(); ++k) {
            surface(scene_.surfaces[k], fmt::format("/surfaces/{}", k));
        }
        for (std::size_t k = 0; k < scene_.bodies.size(); ++k) {
            const std::string at = fmt::format("/bodies/{}", k);
            check_body(scene_.bodies[k], scene_.source, at, problems_);
            if (scene_.bodies[k].shape == "file") {
                file(scene_.bodies[k].file, at);
            }
        }
        for (std::size_t k = 0; k < scene_.particles.size(); ++k) {
            particles(scene_.particles[k], fmt::format("/particles/{}", k));
        }
        for (const auto& [name, list] : {std::pair{"outlets", &scene_.outlets}, std::pair{"measures", &scene_.measures}}) {
            for (std::size_t k = 0; k < list->size(); ++k) {
                box((*list)[k].from, (*list)[k].to, 0.0, fmt::format("/{}/{}", name, k));
            }
        }
    }

  private:
    void say(const std::string& path, const std::string& found, const std::string& expected, const std::string& suggestion = "") {
        problems_.push_back({scene_.source, path, found, expected, suggestion});
    }

    template <class Items> void unique(const std::string& list, const Items& items) {
        std::set<std::string> seen;
        for (std::size_t k = 0; k < items.size(); ++k) {
            const auto usual = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
            const std::string at = fmt::format("/{}/{}/name", list, k);
            if (items[k].name.empty() || !std::all_of(items[k].name.begin(), items[k].name.end(), usual)) {
                say(at, "\"" + items[k].name + "\"", "a name of letters, digits, '_' and '-'");
            } else if (!seen.insert(items[k].name).second) {
                say(at, "\"" + items[k].name + "\" once more", "a name of its own");
            }
        }
    }

    void material(const std::string& name, const std::string& at) {
        if (!name.empty() && std::find(names_.begin(), names_.end(), name) == names_.end()) {
            const std::string best = input::nearest(name, names_);
            say(at + "/material", "\"" + name + "\"", fmt::format("one of the scene's materials: {}", fmt::join(names_, ", ")),
                best.empty() ? "" : "did you mean \"" + best + "\"?");
        }
    }

    // A box with room for something `least` wide.
    void box(const std::vector<double>& from, const std::vector<double>& to, double least, const std::string& at) {
        for (std::size_t c = 0; c < 3; ++c) {
            if (to[c] - from[c] <= 0.0 || to[c] - from[c] < least) {
                say(fmt::format("{}/to/{}", at, c), fmt::format("{:.6g} m, {:.6g} m above from", to[c], to[c] - from[c]),
                    least > 0.0 ? fmt::format("at least a particle's size, {:.6g} m, above from", least) : "above from");
            }
        }
    }

    void file(const std::string& name, const std::string& at) {
        if (name.empty() || !std::filesystem::is_regular_file(std::filesystem::path(scene_.folder) / name)) {
            say(at + "/file", "\"" + name + "\"", "a file that is there, its name relative to the scene's file");
        }
    }

    void need(bool given, const std::string& at, const char* key, const std::string& shape) {
        if (!given) {
            say(at + "/" + key, "none", fmt::format("a {} for a {}", key, shape));
        }
    }

    void surface(const SurfaceInput& s, const std::string& at) {
        material(s.material, at);
        if (s.shape == "plane" || s.shape == "box") {
            const std::size_t sizes = s.shape == "box" ? 3 : 2;
            if (s.size.size() != sizes) {
                say(at + "/size", s.size.empty() ? "no size" : fmt::format("{} numbers", s.size.size()),
                    fmt::format("{} lengths for a {}", sizes, s.shape));
            }
        } else if (s.shape == "file") {
            file(s.file, at);
        } else if (s.shape != "cylinder") {
            need(s.radius > 0.0, at, "radius", s.shape);
        }
        if (s.shape == "cylinder" || s.shape == "helix") {
            need(s.height > 0.0, at, "height", s.shape);
        }
        if (s.shape == "cylinder" && std::max(s.radius, s.top_radius.word.empty() ? s.top_radius.number : s.radius) <= 0.0) {
            say(at + "/radius", "no radius at either end", "a radius above 0 at one end or both");
        }
        if (s.shape == "helix") {
            need(s.pitch != 0.0, at, "pitch", s.shape);
            if (s.inner_radius >= s.radius) {
                say(at + "/inner_radius", fmt::format("{:.6g} m", s.inner_radius), fmt::format("below the radius, {:.6g} m", s.radius));
            }
        }
        check_motion(s.motion, scene_.stop.time, scene_.folder, scene_.source, at + "/motion", problems_);
    }

    void particles(const ParticleInput& p, const std::string& at) {
        material(p.material, at);
        if (p.form == "file") {
            file(p.file, at);
        }
        check_grading(p.grading, scene_.source, at + "/grading", problems_);
        const double size = p.grading.empty() ? p.size : p.grading.back().diameter;
        box(p.from, p.to, size, at);
    }

    const Scene& scene_;
    input::Problems& problems_;
    std::vector<std::string> names_;
};

} // namespace

void check_scene(const Scene& scene, input::Problems& problems) { Check(scene, problems).all(); }

} // namespace proveta
