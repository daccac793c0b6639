// proveta verify
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "core/input/json.hpp"
#include "core/input/suggest.hpp"
#include "lab/cli/commands.hpp"
#include "lab/progress.hpp"
#include "lab/provenance.hpp"
#include "lab/verification/table.hpp"
#include "reports/files.hpp"

namespace proveta {

namespace {

struct VerifyArguments {
    std::vector<std::string> names;
    bool all = false;
    bool list = false;
    std::string out;
};

std::vector<const verification::Case*> chosen_cases(const VerifyArguments& a) {
    std::vector<std::string> known;
    for (const auto& c : verification::cases()) {
        known.push_back(c.name);
    }
    input::Problems problems;
    for (const auto& name : a.names) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            const std::string best = input::nearest(name, known);
            problems.push_back({"verify", "", "\"" + name + "\"", fmt::format("one of {}", fmt::join(known, ", ")),
                                best.empty() ? "" : fmt::format("did you mean \"{}\"?", best)});
        }
    }
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
    std::vector<const verification::Case*> out;
    for (const auto& c : verification::cases()) {
        const bool named = std::find(a.names.begin(), a.names.end(), c.name) != a.names.end();
        if (named || (a.names.empty() && (a.all || !c.is_long))) {
            out.push_back(&c);
        }
    }
    return out;
}

int verify(const VerifyArguments& a) {
    if (a.list) {
        for (const auto& c : verification::cases()) {
            fmt::print("{:<24} {:<10} {}{}\n", c.name, c.section, c.about, c.is_long ? " (long)" : "");
        }
        return 0;
    }
    const auto which = chosen_cases(a);
    if (!a.out.empty()) {
        std::error_code error;
        std::filesystem::create_directories(a.out, error);
        if (error) {
            throw input::InputError({{"--out", "", "\"" + a.out + "\"", "a folder that can be made", error.message()}});
        }
    }
    Progress progress(false);
    std::vector<verification::Finished> finished;
    for (const auto* c : which) {
        progress.show(fmt::format("{} of {}: {}", finished.size() + 1, which.size(), c->name));
        finished.push_back(verification::run(*c));
        if (!a.out.empty()) {
            verification::write_plots(finished.back(), a.out);
        }
    }
    progress.end_line();
    fmt::print("{}", verification::as_text(finished));
    if (!a.out.empty()) {
        const std::string page =
            "# Verification\n\nMade by `proveta verify`: every case computed against an answer that is known independently.\n";
        report::write_file((std::filesystem::path(a.out) / "verification.md").string(), page + verification::as_markdown(finished, "."));
    }
    const auto wrong = std::count_if(finished.begin(), finished.end(), [](const auto& f) { return !f.holds(); });
    fmt::print("{} of {} cases hold\n", finished.size() - static_cast<std::size_t>(wrong), finished.size());
    return wrong == 0 ? 0 : exit_calculation;
}

} // namespace

void add_verify(CLI::App& app, Command& chosen) {
    auto a = std::make_shared<VerifyArguments>();
    auto* command = app.add_subcommand("verify", "compute cases with known answers and compare");
    command->add_option("cases", a->names, "cases to compute (default: all but the long ones)");
    command->add_flag("--all", a->all, "the long cases too");
    command->add_flag("--list", a->list, "list the cases and compute nothing");
    command->add_option("--out", a->out, "folder for the table (verification.md), the plots (SVG) and their data (CSV)");
    command->callback([a, &chosen] { chosen = [a] { return verify(*a); }; });
}

} // namespace proveta
