#include "specimens/memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>

namespace proveta {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t less(std::uint64_t a, std::uint64_t b) { return a > b ? a - b : 0; }

// The number in a file of one number; none for a file that is not there or says "max".
std::optional<std::uint64_t> number_in(const fs::path& file) {
    std::ifstream in(file);
    std::uint64_t value = 0;
    return in >> value ? std::optional(value) : std::nullopt;
}

// The number behind a word that begins a line.
std::optional<std::uint64_t> number_after(const fs::path& file, const std::string& word) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with(word)) {
            std::uint64_t value = 0;
            return std::sscanf(line.c_str() + word.size(), "%lu", &value) == 1 ? std::optional(value) : std::nullopt;
        }
    }
    return std::nullopt;
}

std::uint64_t left_in_group(const fs::path& group) {
    const auto most = number_in(group / "memory.max");
    const auto now = number_in(group / "memory.current");
    if (!most || !now) {
        return unlimited;
    }
    return less(*most, less(*now, number_after(group / "memory.stat", "inactive_file ").value_or(0)));
}

// The process' group and all those that it is in have limits of their own.
std::uint64_t left_in_groups(const fs::path& root) {
    std::ifstream in(root / "proc/self/cgroup");
    fs::path group;
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with("0::/")) {
            group = line.substr(4);
        }
    }
    std::uint64_t left = left_in_group(root / "sys/fs/cgroup");
    for (; !group.empty(); group = group.parent_path()) {
        left = std::min(left, left_in_group(root / "sys/fs/cgroup" / group));
    }
    return left;
}

std::uint64_t left_of_addresses(const fs::path& root) {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
        return unlimited;
    }
    const auto pages = number_in(root / "proc/self/statm").value_or(0);
    return less(limit.rlim_cur, pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)));
}

std::string in_gib(std::uint64_t bytes) { return fmt::format("{:.2f} GiB", std::ldexp(static_cast<double>(bytes), -30)); }

} // namespace

std::uint64_t available_memory(const std::string& root) {
    std::uint64_t left = std::min(left_in_groups(root), left_of_addresses(root));
    if (const auto kib = number_after(fs::path(root) / "proc/meminfo", "MemAvailable:")) {
        left = std::min(left, *kib * 1024);
    }
    return left;
}

void require_file(const std::string& file, double growth) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) {
        throw std::runtime_error(file + ": no such file");
    }
    const std::uintmax_t size = fs::file_size(file, error);
    if (error || size > largest_file) {
        throw std::runtime_error(fmt::format("{}: more than {} MiB", file, largest_file >> 20));
    }
    if (const std::uint64_t there = available_memory(); growth * static_cast<double>(size) > static_cast<double>(there)) {
        throw std::runtime_error(fmt::format("{}: {} bytes, which need about {} of memory where {} are available", file, size,
                                             in_gib(static_cast<std::uint64_t>(growth * static_cast<double>(size))), in_gib(there)));
    }
}

std::uint64_t memory_needed(std::uint64_t spheres, double coordination) {
    // Measured as the peak of resident memory with 5 000, 20 000 and 60 000 spheres, of coordination 10 and 20: 1.0 kB a sphere in packing,
    // 3.1 to 3.5 kB from bonding on.
    constexpr double program = 40e6;
    constexpr double of_sphere = 1800.0;
    constexpr double of_bond = 350.0;
    constexpr double most = 1e19; // that the number of bytes can be
    return static_cast<std::uint64_t>(std::min(most, program + static_cast<double>(spheres) * (of_sphere + of_bond * 0.5 * coordination)));
}

void require_memory(std::uint64_t spheres, const std::string& source, const std::string& path, const std::string& found) {
    constexpr double usual = 10.0; // most tests bond at this one; a loose sphere has fewer contacts
    const std::uint64_t needed = memory_needed(spheres, usual);
    const std::uint64_t there = available_memory();
    if (needed > there) {
        throw input::InputError({{source, path, fmt::format("{}, which need about {} of memory", found, in_gib(needed)),
                                  fmt::format("no more than go into the {} that are available", in_gib(there)),
                                  "fewer spheres, or a machine or limit with more memory"}});
    }
}

void require_memory(const SpecimenRecipe& r, const std::string& source, const std::string& path) {
    if (!r.granular()) {
        require_memory(static_cast<std::uint64_t>(r.spheres), source, path + "/spheres", fmt::format("{} spheres", r.spheres));
        return;
    }
    const double stones = particles_of(r.particles, shape_of(r));
    const double each = r.particles.form == "stone" ? static_cast<double>(r.particles.spheres) : 1.0;
    const char* key = r.particles.count.word.empty() ? "/count" : r.particles.size.word.empty() ? "/size" : "/grading";
    require_memory(static_cast<std::uint64_t>(std::min(stones * each, 1e15)), source, path + "/particles" + key,
                   fmt::format("{:.0f} particles of up to {:.0f} spheres", stones, each));
}

} // namespace proveta
