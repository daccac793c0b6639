// The memory that is there, by what the system says, and what is refused for want of it.
#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>

#include "core/input/text_file.hpp"
#include "specimens/memory.hpp"
#include "tests/support.hpp"

using namespace proveta;
using testing::TemporaryFolder;

namespace {

constexpr std::uint64_t GiB = std::uint64_t{1} << 30;

// A system's files below a folder.
class System {
  public:
    void say(const std::string& file, const std::string& text) const {
        std::filesystem::create_directories((folder_.path() / file).parent_path());
        folder_.write(file, text);
    }
    [[nodiscard]] std::uint64_t available() const { return available_memory(folder_.path().string()); }

  private:
    TemporaryFolder folder_;
};

} // namespace

TEST_CASE("memory: the least of what the machine and the control groups give") {
    const System system;
    CHECK(system.available() > 1000 * GiB); // nobody says anything
    system.say("proc/meminfo", "MemTotal:       16777216 kB\nMemFree:  1 kB\nMemAvailable:    8388608 kB\n");
    CHECK(system.available() == 8 * GiB);
    system.say("proc/self/cgroup", "0::/user/job\n");
    system.say("sys/fs/cgroup/user/job/memory.max", "max\n");
    system.say("sys/fs/cgroup/user/job/memory.current", "1000\n");
    CHECK(system.available() == 8 * GiB);
    system.say("sys/fs/cgroup/user/memory.max", std::to_string(5 * GiB) + "\n");
    system.say("sys/fs/cgroup/user/memory.current", std::to_string(2 * GiB) + "\n");
    CHECK(system.available() == 3 * GiB);
    system.say("sys/fs/cgroup/user/memory.stat", "anon 5\ninactive_file " + std::to_string(GiB) + "\n");
    CHECK(system.available() == 4 * GiB);
    system.say("sys/fs/cgroup/memory.max", std::to_string(GiB) + "\n");
    system.say("sys/fs/cgroup/memory.current", std::to_string(2 * GiB) + "\n");
    CHECK(system.available() == 0);
}

TEST_CASE("memory: recipes that need more than there is are refused where their number of spheres is set") {
    CHECK(memory_needed(60000, 10.0) > 190000000); // 234 MB and 98 MB were measured, the program's own 40 MB among them
    CHECK(memory_needed(60000, 10.0) < 300000000);
    const auto refused = [](const SpecimenRecipe& recipe, const std::string& path) {
        try {
            require_memory(recipe, "deck.json", "/specimen");
        } catch (const input::InputError& error) {
            CHECK(error.problems.front().path == path);
            CHECK(error.problems.front().found.find("GiB") != std::string::npos);
            CHECK(error.problems.front().expected.find("GiB") != std::string::npos);
            return true;
        }
        return false;
    };
    SpecimenRecipe recipe;
    CHECK_FALSE(refused(recipe, ""));
    recipe.spheres = std::int64_t{1} << 40;
    CHECK(refused(recipe, "/specimen/spheres"));
    SpecimenRecipe bed = granular_recipe();
    CHECK_FALSE(refused(bed, ""));
    bed.particles.count = {1e12, ""};
    CHECK(refused(bed, "/specimen/particles/count"));
    bed.particles.count = {0.0, "auto"};
    bed.particles.size = {1e-6, ""};
    CHECK(refused(bed, "/specimen/particles/size"));
}

TEST_CASE("memory: files that are larger than any that is meant are not read") {
    const TemporaryFolder folder;
    const std::string file = folder.file("sparse", "x");
    std::filesystem::resize_file(file, 10 * GiB);
    CHECK_THROWS_WITH(require_file(file), Catch::Contains("more than 1024 MiB"));
    CHECK_THROWS_WITH(input::read_text(file, 1000), Catch::Contains("more than"));
    CHECK_THROWS_WITH(input::read_text("/dev/zero", 1 << 20), Catch::Contains("more than 1 MiB"));
    CHECK_THROWS_WITH(input::read_text(folder.path().string(), 1000), Catch::Contains("a folder"));
    CHECK_THROWS_WITH(require_file("/dev/zero"), Catch::Contains("no such file"));
    CHECK(input::read_text(folder.file("a", "text\n"), 5) == "text\n");
    CHECK_THROWS_WITH(input::read_text(folder.file("a"), 4), Catch::Contains("more than"));
    std::filesystem::resize_file(file, GiB / 2);
    CHECK_THROWS_WITH(require_file(file, 1e9), Catch::Contains("are available"));
}
