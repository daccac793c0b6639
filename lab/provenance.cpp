#include "lab/provenance.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <set>

#include "core/hash.hpp"
#include "core/parallel/instruction_set.hpp"
#include "lab/revision.hpp"

namespace proveta {

std::string version() { return PROVETA_VERSION; }

std::string version_text() {
    const int threads = omp_get_max_threads();
    return fmt::format("proveta {} ({}, physics {}, {}, {}, {}, {} {})", version(), git_revision(), physics_revision(), PROVETA_COMPILER,
                       PROVETA_BUILD, instruction_set_name(), threads, threads == 1 ? "thread" : "threads");
}

input::Json program_facts() {
    return {{"version", version()},         {"revision", git_revision()}, {"physics", physics_revision()},
            {"compiler", PROVETA_COMPILER}, {"build", PROVETA_BUILD},     {"vector_kernel", instruction_set_name()}};
}

std::vector<std::string> physics_of(const input::Json& manifest) {
    std::vector<std::string> out;
    const auto add = [&](const input::Json& program) {
        if (std::string physics = input::text_at(program, "physics"); !physics.empty()) {
            out.push_back(std::move(physics));
        }
    };
    add(manifest);
    if (manifest.is_object() && manifest.contains("resumed_by") && manifest["resumed_by"].is_array()) {
        for (const auto& program : manifest["resumed_by"]) {
            add(program);
        }
    }
    return out;
}

std::string other_physics(const input::Json& manifest) {
    const auto all = physics_of(manifest);
    if (!all.empty() && std::all_of(all.begin(), all.end(), [](const std::string& physics) { return physics == physics_revision(); })) {
        return "";
    }
    return fmt::format("{}, and this program is physics {}",
                       all.empty() ? std::string("a version without physics revision") : fmt::format("physics {}", fmt::join(all, " and ")),
                       physics_revision());
}

std::string physics_warning(const input::Json& manifest) {
    const auto all = physics_of(manifest);
    if (all.size() > 1) {
        return fmt::format("Computed by more than one physics: {}.", fmt::join(all, ", then "));
    }
    return all.empty() || all.front() == physics_revision()
               ? ""
               : fmt::format("Computed by physics {}, and reported by a program of physics {}.", all.front(), physics_revision());
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

std::string hash_of_text(const std::string& text) {
    Hash hash;
    for (const unsigned char c : text) {
        hash.mix(static_cast<std::uint64_t>(c));
    }
    return hex(hash.value());
}

std::string hash_of_file(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in || !std::filesystem::is_regular_file(file)) {
        return "";
    }
    Hash hash;
    char buffer[65536];
    while (in.read(buffer, sizeof buffer) || in.gcount() > 0) {
        hash.mix(buffer, static_cast<std::size_t>(in.gcount()));
    }
    return hex(hash.value());
}

std::vector<std::string> files_of(const Deck& deck) {
    std::vector<std::string> names{deck.source, deck.material.card, deck.specimen.file};
    for (const auto& region : deck.regions) {
        names.push_back(region.material.card);
    }
    std::vector<std::string> files;
    for (const auto& name : names) {
        if (!name.empty()) { // that of the deck stands as it was given
            files.push_back(name == deck.source ? name : (std::filesystem::path(deck.folder) / name).string());
        }
    }
    return files;
}

input::Json hashes_of(const std::vector<std::string>& files) {
    input::Json out = input::Json::object();
    for (const auto& name : files) {
        const std::string file = std::filesystem::absolute(name).lexically_normal().string();
        if (const std::string hash = hash_of_file(file); !hash.empty()) {
            out[file] = hash;
        }
    }
    return out;
}

input::Json manifest(const Deck& deck, const Bench& bench, const std::string& command, const std::string& folder) {
    input::Json j;
    j["proveta_manifest"] = 1;
    j["status"] = "running";
    j["command"] = command;
    j["repeat_with"] = fmt::format("proveta run {}/manifest.json --out NEW_FOLDER", folder);
    j.update(program_facts());
    j["threads"] = omp_get_max_threads();
    j["started"] = now_utc();
    j["resumed"] = input::Json::array();
    j["deck_file"] = deck.source;
    j["files"] = hashes_of(files_of(deck));
    j["card"] = deck.material.card;
    j["seed"] = deck.specimen.seed;
    j["specimen_hash"] = hex(bench.specimen_hash);
    j["specimen"] = bench.specimen.recipe;
    j["time_step_s"] = bench.model->dt();
    j["deck"] = resolved(deck);
    return j;
}

input::Json manifest_to_go_on_with(const std::string& file, const input::Json& fresh, bool runs_on) {
    std::ifstream in(file);
    input::Json j = in ? input::Json::parse(in, nullptr, false) : input::Json();
    if (!j.is_object()) {
        return fresh;
    }
    if (runs_on) {
        j["threads"] = omp_get_max_threads();
        if (!j["resumed"].is_array()) {
            j["resumed"] = input::Json::array();
        }
        j["resumed"].push_back(now_utc());
        if (const auto all = physics_of(j); all.empty() || all.back() != physics_revision()) {
            j["resumed_by"].push_back(program_facts());
        }
    }
    return j;
}

input::Json with_beginning_of(const std::string& file, input::Json fresh) {
    std::ifstream in(file);
    const input::Json there = in ? input::Json::parse(in, nullptr, false) : input::Json();
    std::vector<std::string> kept{"command", "started"};
    const input::Json facts = program_facts(); // outlives its items
    for (const auto& [key, value] : facts.items()) {
        kept.push_back(key);
    }
    for (const auto& key : kept) {
        if (there.is_object() && there.contains(key)) {
            fresh[key] = there[key];
        }
    }
    return fresh;
}

namespace {

// Files of specimens in the decks of a manifest.
std::set<std::string> stored_specimens(const input::Json& json) {
    std::set<std::string> out;
    for (const auto& [key, value] : json.items()) {
        if (key == "specimen" && value.is_object()) {
            out.insert(input::text_at(value, "file"));
        } else if (value.is_structured()) {
            out.merge(stored_specimens(value));
        }
    }
    return out;
}

} // namespace

std::vector<std::string> changed_specimens(const input::Json& manifest) {
    std::vector<std::string> out;
    for (const auto& file : stored_specimens(manifest)) {
        const std::string then = manifest.contains("files") ? input::text_at(manifest["files"], file.c_str()) : "";
        if (!then.empty() && then != hash_of_file(file)) {
            out.push_back(file);
        }
    }
    return out;
}

std::vector<std::string> changes_since(const input::Json& manifest) {
    std::vector<std::string> out;
    const auto compare = [&](const char* key, const std::string& now, const char* consequence) {
        if (const std::string then = input::text_at(manifest, key); !then.empty() && then != now) {
            out.push_back(fmt::format("{} was \"{}\" and is \"{}\" now: {}", key, then, now, consequence));
        }
    };
    const char* rounding = "results may differ in their last digits from those of a run that was never stopped";
    compare("version", version(), rounding);
    compare("compiler", PROVETA_COMPILER, rounding);
    compare("build", PROVETA_BUILD, rounding);
    if (manifest.contains("files") && manifest["files"].is_object()) {
        const auto specimens = changed_specimens(manifest);
        for (const auto& [file, hash] : manifest["files"].items()) {
            const std::string now = hash_of_file(file);
            if (hash.is_string() && now != hash.get<std::string>() &&
                std::find(specimens.begin(), specimens.end(), file) == specimens.end()) { // of which more is said
                out.push_back(fmt::format("{} {} since the test began; it goes on with what it began with", file,
                                          now.empty() ? "has gone" : "has changed"));
            }
        }
    }
    return out;
}

} // namespace proveta
