// proveta scene
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "lab/cli/commands.hpp"
#include "lab/progress.hpp"
#include "lab/scene/run_scene.hpp"

namespace proveta {

namespace {

struct SceneArguments : RunArguments {
    std::string file;
    bool check = false;
};

} // namespace

void add_scene(CLI::App& app, const std::string& typed, Command& chosen) {
    auto a = std::make_shared<SceneArguments>();
    auto* command = app.add_subcommand("scene", "particles that fall, pour and flow among surfaces that move");
    command->add_option("file", a->file, "scene (JSON), or the manifest.json of an earlier one")->required();
    add_settings(*command, *a);
    add_output(*command, *a, "results/NAME of the scene");
    command->add_flag("--check", a->check, "report all problems without running it");
    command->callback([a, typed, &chosen] {
        chosen = [a, typed] {
            use_threads(a->threads);
            const Scene scene = read_scene(a->file, a->settings);
            if (a->check) {
                try_scene(scene);
                fmt::print("{}: no problems; a scene of {} surfaces and {} kinds of particles\n", a->file, scene.surfaces.size(),
                           scene.particles.size());
                return 0;
            }
            const RunOptions options{a->out.empty() ? "results/" + result_name(a->file, "scene") : a->out, typed, a->quiet};
            catch_interrupts();
            return exit_code(run_scene(scene, options));
        };
    });
}

} // namespace proveta
