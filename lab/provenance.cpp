#include "lab/provenance.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <ctime>

#include "core/parallel/instruction_set.hpp"
namespace proveta {

std::string version() { return PROVETA_VERSION; }

std::string version_text() {
    return fmt::format("proveta {}\ncompiler {}\nbuild {}\nvector kernel {}\nthreads {}", version(), PROVETA_COMPILER, PROVETA_BUILD,
                       instruction_set_name(), omp_get_max_threads());
}

std::string now_utc() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text;
}

std::string hex(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

input::Json manifest(const Deck& deck, const Bench& bench, const std::string& command, const std::string& status,
                     const std::string& started, const std::string& folder) {
    input::Json j;
    j["proveta_manifest"] = 1;
    j["status"] = status;
    j["command"] = command;
    j["repeat_with"] = fmt::format("proveta run {}/manifest.json --out NEW_FOLDER", folder);
    j["version"] = version();
    j["compiler"] = PROVETA_COMPILER;
    j["build"] = PROVETA_BUILD;
    j["vector_kernel"] = instruction_set_name();
    j["threads"] = omp_get_max_threads();
    j["started"] = started;
    j["deck_file"] = deck.source;
    j["card"] = deck.material.card;
    j["seed"] = deck.specimen.seed;
    j["specimen_hash"] = hex(bench.specimen_hash);
    j["specimen"] = bench.specimen.recipe;
    j["time_step_s"] = bench.model->dt();
    j["deck"] = resolved(deck);
    return j;
}

} // namespace proveta
