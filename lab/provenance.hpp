// Where a result comes from: enough to repeat it.
#pragma once

#include <string>
#include <vector>

#include "core/input/json.hpp"
#include "lab/bench.hpp"

namespace proveta {

/// Program version, e.g. "0.1.0".
std::string version();

/// For --version: "proveta 0.1.0 (v0.1.0-14-g53fa0ab, physics 3f9c01d2a1b2, GNU 12.2.0, Release, AVX-512, 2 threads)".
std::string version_text();

/// The program, for manifests: "version", "revision" of git, "physics", "compiler", "build" and "vector_kernel".
input::Json program_facts();

/// The physics revision that a manifest names, and those that went on with it; empty for one from before there were any.
std::vector<std::string> physics_of(const input::Json& manifest);

/// What a manifest speaks of was computed by another physics than this program's, at least in part: "physics 3f9c01d2a1b2, and this program
/// is physics 53fa0ab3c4d5"; empty where it was not.
std::string other_physics(const input::Json& manifest);

/// What a page is to say of a result that was not computed by this program's physics from its start to its end; empty otherwise.
std::string physics_warning(const input::Json& manifest);

/// UTC time as "2026-01-31T12:00:00Z".
std::string now_utc();

/// A 64-bit hash as 16 hexadecimal digits.
std::string hex(std::uint64_t hash);

/// Hash of a text as 16 hexadecimal digits. It names trials and their folders: another one would not find them again.
std::string hash_of_text(const std::string& text);

/// Hash of a file's bytes as 16 hexadecimal digits; empty when it cannot be read.
std::string hash_of_file(const std::string& file);

/// Hashes of the files that can be read, by their names without detours.
input::Json hashes_of(const std::vector<std::string>& files);

/// Files that a test was read from: its deck, its cards, its specimen.
std::vector<std::string> files_of(const Deck& deck);

/// manifest.json of a test that starts now: the resolved deck, versions, threads, seed, the files it was read from, hashes, and the command
/// that runs it again. Its "status" is to be running, complete, interrupted or failed.
input::Json manifest(const Deck& deck, const Bench& bench, const std::string& command, const std::string& folder);

/// The manifest that a test begun earlier left in its folder; `fresh` when it left none. runs_on: it takes more steps; the time of that is
/// noted, and the program where it is of another physics than that it was begun by.
input::Json manifest_to_go_on_with(const std::string& file, const input::Json& fresh, bool runs_on);

/// A fresh manifest with the program, the command and the start of that in a file, where it has them: of what is only reported.
input::Json with_beginning_of(const std::string& file, input::Json fresh);

/// Files of specimens in the decks of a manifest that have changed, or gone, since it was written. They are read again, so that nothing can
/// go on with them.
std::vector<std::string> changed_specimens(const input::Json& manifest);

/// What is different now from when a manifest was written, a sentence each: the program, and files that the test was read from. The test
/// goes on with what the manifest says all the same.
std::vector<std::string> changes_since(const input::Json& manifest);

} // namespace proveta
