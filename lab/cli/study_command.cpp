// proveta study rate|step|size
#include <fmt/format.h>
#include <omp.h>

#include <filesystem>
#include <memory>

#include "lab/cli/commands.hpp"
#include "lab/progress.hpp"
#include "lab/study/study.hpp"

namespace proveta {

namespace {

struct StudyArguments : RunArguments {
    StudyRequest request;
};

int carry_out_study(const StudyArguments& a, const char* name, const std::string& typed) {
    use_threads(a.threads);
    StudyRequest request = a.request;
    request.settings = a.settings;
    Looks looks;
    Plan plan;
    const bool read = looks.at([&] { plan = plan_study(request); });
    looks.at_folder(a.out);
    if (read && (a.check || !looks.good())) { // else the series says it first
        looks.at([&] { check_members(plan); });
    }
    looks.settle();
    if (a.check) {
        fmt::print("{}: no problems; a study of {} tests\n", a.request.deck, plan.members.size());
        return 0;
    }
    const std::string stem = result_name(a.request.deck, "test");
    const RunOptions options{a.out.empty() ? fmt::format("results/{}-{}-study", stem, name) : a.out, typed, a.quiet};
    catch_interrupts();
    return exit_code(run_series(plan, options, omp_get_max_threads(), study_of(plan)));
}

} // namespace

void add_study(CLI::App& app, const std::string& typed, Command& chosen) {
    auto* group =
        app.add_subcommand("study", "one test at several loading rates, time steps or numbers of spheres, and where its results go");
    group->require_subcommand(1);
    const auto add = [&](StudyKind kind, const char* name, const char* about, const char* values, int seeds) {
        auto a = std::make_shared<StudyArguments>();
        a->request.kind = kind;
        a->request.seeds = seeds;
        auto* command = group->add_subcommand(name, about);
        command->add_option("deck", a->request.deck, "deck of one test (JSON)")->required();
        command->add_option("--values", a->request.values, values)->delimiter(',');
        command->add_option("--seeds", a->request.seeds, "specimens for each value")->check(CLI::Range(1, 100))->capture_default_str();
        add_settings(*command, *a);
        add_output(*command, *a, "results/NAME-KIND-study");
        command->callback([a, name, typed, &chosen] { chosen = [a, name, typed] { return carry_out_study(*a, name, typed); }; });
    };
    add(StudyKind::rate, "rate", "how results depend on the loading rate, and their limit at rate 0",
        "closing speeds in m/s, such as 0.2,0.1,0.05 (default: 4, 2, 1 and 1/2 of the deck's, or about a sixth of the height a second)", 1);
    add(StudyKind::step, "step", "how results depend on the time step, and their limit at step 0",
        "steps over the stable one (default: 0.9,0.6,0.3,0.15)", 1);
    add(StudyKind::size, "size", "how results depend on the number of spheres, and their limit for ever finer ones",
        "numbers of spheres (default: 1/10, 1/4, 1/2 and all of the deck's)", 3);
}

} // namespace proveta
