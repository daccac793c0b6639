// proveta scene
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>

#include "lab/cli/commands.hpp"
#include "lab/progress.hpp"
#include "lab/scene/run_scene.hpp"

namespace proveta {

int play(const SceneArguments& a, const std::string& typed) {
    use_threads(a.threads);
    Looks looks;
    Scene scene;
    const bool read = looks.at([&] { scene = read_scene(a.file, a.settings); });
    looks.at_folder(a.out);
    if (read && (a.check || !looks.good())) { // else the run says it, as soon
        looks.at([&] { try_scene(scene); });
    }
    looks.settle();
    if (a.check) {
        fmt::print("{}: no problems; a scene of {} surfaces and {} kinds of particles\n", a.file, scene.surfaces.size(),
                   scene.particles.size());
        return 0;
    }
    const RunOptions options{a.out.empty() ? "results/" + result_name(a.file, "scene") : a.out, typed, a.quiet};
    catch_interrupts();
    return exit_code(run_scene(scene, options));
}

void add_scene(CLI::App& app, const std::string& typed, Command& chosen) {
    auto a = std::make_shared<SceneArguments>();
    auto* command = app.add_subcommand("scene", "particles that fall, pour and flow among surfaces that move");
    command->add_option("file", a->file, "scene (JSON), or the manifest.json of an earlier one")->required();
    add_settings(*command, *a);
    add_output(*command, *a, "results/NAME of the scene");
    command->callback([a, typed, &chosen] { chosen = [a, typed] { return play(*a, typed); }; });
}

} // namespace proveta
