// All that the fuzzers have kept, read again: seeds, and the files that were defects once. None may end the program or take long.
#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/fuzz/targets.hpp"

namespace {

namespace fs = std::filesystem;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double longest = 20.0; // s
#elif defined(__has_feature)
constexpr double longest = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) ? 20.0 : 1.0;
#else
constexpr double longest = 1.0;
#endif

std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> out;
    if (fs::is_directory(folder)) {
        for (const auto& entry : fs::directory_iterator(folder)) {
            out.push_back(entry.path());
        }
    }
    return out;
}

// True when the target takes or refuses the file, in time.
bool replay(const proveta::fuzz::Target& target, const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    const auto start = std::chrono::steady_clock::now();
    try {
        target.read(bytes);
    } catch (const std::exception& e) {
        fmt::print("{}: {}\n", file.string(), e.what());
        return false;
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (seconds > longest) {
        fmt::print("{}: took {:.1f} s\n", file.string(), seconds);
    }
    return seconds <= longest;
}

} // namespace

// Usage: replay FOLDER, which holds corpus/TARGET and regressions/TARGET.
int main(int argc, char** argv) {
    const fs::path folder = argc > 1 ? argv[1] : ".";
    int failed = 0;
    for (const auto& target : proveta::fuzz::targets) {
        std::size_t read = 0;
        for (const char* kind : {"corpus", "regressions"}) {
            for (const auto& file : files_in(folder / kind / target.name)) {
                fmt::print("{}\n", file.string()); // the last one seen is the one to blame when the program dies
                std::fflush(stdout);
                failed += replay(target, file) ? 0 : 1;
                ++read;
            }
        }
        if (read == 0) {
            fmt::print("{}: no files\n", target.name);
            ++failed;
        }
    }
    return failed == 0 ? 0 : 1;
}
