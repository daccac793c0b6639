// proveta: a virtual materials laboratory.
#include <fcntl.h>
#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#include "core/files/whole_file.hpp"
#include "core/input/json.hpp"
#include "core/input/suggest.hpp"
#include "lab/cli/commands.hpp"
#include "lab/provenance.hpp"

namespace proveta {

// Message for a first word that is no command.
std::string unknown_command(const CLI::App& app, const std::string& word) {
    std::vector<std::string> names;
    for (const auto* command : app.get_subcommands(nullptr)) {
        names.push_back(command->get_name());
    }
    const std::string best = input::nearest(word, names);
    return fmt::format("\"{}\" is no command; expected one of {}{}", word, fmt::join(names, ", "),
                       best.empty() ? "" : fmt::format("; did you mean \"{}\"?", best));
}

} // namespace proveta

namespace {

// Where threads of OpenMP run out of memory nobody can catch it.
[[noreturn]] void end_with_a_word() {
    try {
        if (const auto cause = std::current_exception()) {
            std::rethrow_exception(cause);
        }
        std::fputs("error: the program ended itself\n", stderr);
    } catch (const std::bad_alloc&) {
        std::fputs("error: not enough memory; ask for fewer spheres, or coarser surfaces\n", stderr);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "error: %s\n", e.what());
    } catch (...) {
        std::fputs("error: something unknown was thrown\n", stderr);
    }
    std::_Exit(proveta::exit_calculation);
}

int guarded(const proveta::Command& command) {
    try {
        return command();
    } catch (const proveta::input::InputError& e) {
        for (const auto& problem : e.problems) {
            spdlog::error("{}", problem.text());
        }
        return proveta::exit_input;
    } catch (const proveta::FileError& e) {
        spdlog::error("{}", e.what());
        return proveta::exit_files;
    } catch (const std::filesystem::filesystem_error& e) {
        spdlog::error("{}: {}", e.path1().string(), e.code().message());
        return proveta::exit_files;
    } catch (const std::system_error& e) { // of what is printed
        if (e.code().value() == EPIPE) {
            std::clearerr(stdout); // a reader that has gone has seen enough
            return 0;
        }
        spdlog::error("not all could be printed: {}", e.code().message());
        return proveta::exit_files;
    } catch (const std::bad_alloc&) {
        spdlog::error("not enough memory; ask for fewer spheres, or coarser surfaces");
        return proveta::exit_calculation;
    } catch (const std::exception& e) {
        constexpr int not_utf8 = 316; // nlohmann-json's number of it
        if (const auto* json = dynamic_cast<const proveta::input::Json::type_error*>(&e); json != nullptr && json->id == not_utf8) {
            spdlog::error("a text or a path is not UTF-8, which it has to be to be written down ({})", e.what());
            return proveta::exit_input;
        }
        spdlog::error("{}", e.what());
        return proveta::exit_calculation;
    }
}

// A file opened where a standard stream was closed would take what is meant for that.
void hold_standard_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(stream, F_GETFD) < 0) {
            (void)!open("/dev/null", O_RDWR); // takes the lowest number that is free
        }
    }
}

// What could not be printed is no success; a reader that has gone has seen enough.
int with_all_printed(int code) {
    errno = 0;
    if ((std::fflush(stdout) != 0 || std::ferror(stdout) != 0) && errno != EPIPE && code == 0) {
        spdlog::error("not all could be printed: {}", errno != 0 ? std::strerror(errno) : "the standard output cannot be written");
        return proveta::exit_files;
    }
    return code;
}

} // namespace

int main(int argc, char** argv) {
    hold_standard_streams();
    spdlog::set_default_logger(spdlog::stderr_color_mt("proveta"));
    spdlog::set_pattern("%^%l%$: %v");

    std::string typed = "proveta";
    for (int k = 1; k < argc; ++k) {
        typed += std::string(" ") + argv[k];
    }
    std::set_terminate(end_with_a_word);
    std::signal(SIGXFSZ, SIG_IGN); // a file over its limit is an error like a full disk
    std::signal(SIGPIPE, SIG_IGN); // a reader of ours that has gone is no reason to lose a calculation
    CLI::App app{"Proveta, a virtual materials laboratory: makes a specimen out of bonded spheres, puts it in the press and breaks it.",
                 "proveta"};
    app.set_version_flag("--version", proveta::version_text());
    app.require_subcommand(1);
    app.footer("Exit codes: 0 done, 2 the input is wrong, 3 the calculation failed, 4 files cannot be written, 130, 143 or 129 interrupted "
               "by Ctrl-C, SIGTERM or a terminal that closed.");
    proveta::Command chosen;
    proveta::add_run(app, typed, chosen);
    proveta::add_resume(app, typed, chosen);
    proveta::add_report(app, typed, chosen);
    proveta::add_compare(app, typed, chosen);
    proveta::add_plot(app, chosen);
    proveta::add_check(app, typed, chosen);
    proveta::add_describe(app, chosen);
    proveta::add_schema(app, chosen);
    proveta::add_specimen(app, chosen);
    proveta::add_elastic(app, chosen);
    proveta::add_study(app, typed, chosen);
    proveta::add_calibrate(app, typed, chosen);
    proveta::add_sweep(app, typed, chosen);
    proveta::add_trial(app, chosen);
    proveta::add_scene(app, typed, chosen);
    proveta::add_verify(app, chosen);
    proveta::add_bench(app, chosen);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        const bool unknown = dynamic_cast<const CLI::RequiredError*>(&e) != nullptr && app.get_subcommands().empty() && argc > 1;
        if (unknown) {
            spdlog::error("{}", proveta::unknown_command(app, argv[1]));
            return proveta::exit_input;
        }
        return app.exit(e) == 0 ? 0 : proveta::exit_input;
    }
    return with_all_printed(guarded(chosen));
}
