#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>
#include <vector>

#include "core/contacts/loads.hpp"
#include "core/parallel/team.hpp"

using namespace proveta;

TEST_CASE("a team does every part once, whatever their number and its own") {
    for (const int threads : {0, 1, 2, 3, 7}) {
        Team team(threads);
        CHECK(team.threads() == std::max(1, threads));
        for (const std::size_t parts : {0, 1, 2, 5, 64, 1000}) {
            std::vector<std::atomic<int>> done(parts);
            for (int round = 0; round < 20; ++round) {
                team.run(parts, [&](std::size_t k) { done[k].fetch_add(1); });
            }
            CHECK(std::all_of(done.begin(), done.end(), [](const auto& d) { return d.load() == 20; }));
        }
    }
}

TEST_CASE("a team that sleeps between jobs wakes for the next, and helps where a part is slow") {
    Team team(2);
    std::vector<std::thread::id> by(8);
    bool helped = false;
    for (int round = 0; round < 5; ++round) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        std::atomic<int> count{0};
        team.run(by.size(), [&](std::size_t k) {
            if (k == 0) {
                std::this_thread::sleep_for(std::chrono::milliseconds(20));
            }
            by[k] = std::this_thread::get_id();
            ++count;
        });
        CHECK(count == 8);
        helped = helped || (by[1] != by[0] && by[3] != by[0]); // who sleeps in part 0 leaves the rest of its share to the other
    }
    CHECK(helped);
}

TEST_CASE("kept rows reach their spheres: loads add up as in one plain loop") {
    constexpr std::size_t n = 3 * spheres_per_block + 17;
    std::vector<std::int32_t> i;
    std::vector<std::int32_t> j;
    std::vector<std::int32_t> row;
    for (std::size_t k = 0; k < n; ++k) {
        for (const std::size_t far : {1u, 13u, 300u, 700u}) {
            if (k + far < n) {
                i.push_back(static_cast<std::int32_t>(k));
                j.push_back(static_cast<std::int32_t>(k + far));
            }
        }
    }
    Loads loads(n);
    loads.arrange({{i, j, row}});
    REQUIRE(row.size() == i.size());
    CHECK(loads.blocks().size() == 4);
    CHECK(loads.kept() > 0);
    std::vector<double> expected(n, 0.0);
    loads.add(5, {0.0, 100.0, 0.0}, Vec3::Zero());
    expected[5] += 100.0;
    for (int round = 0; round < 2; ++round) { // the second time the kept rows are not empty to begin with
        for (const auto& block : loads.blocks()) {
            loads.clear_kept(block);
        }
        for (std::size_t k = 0; k < i.size(); ++k) {
            const double f = 1.0 + static_cast<double>(k % 11);
            loads.row(static_cast<std::size_t>(i[k])).force[1] += f;
            loads.row(static_cast<std::size_t>(row[k])).force[1] -= f;
            expected[static_cast<std::size_t>(i[k])] += f;
            expected[static_cast<std::size_t>(j[k])] -= f;
        }
        for (const auto& block : loads.blocks()) {
            loads.collect(block);
        }
    }
    for (std::size_t k = 0; k < n; ++k) {
        CHECK(loads.row(k).force[1] == expected[k]);
    }
}

TEST_CASE("a team hands on what a part threw, does the other parts, and works on afterwards") {
    for (const int threads : {1, 3}) {
        Team team(threads);
        std::atomic<int> done{0};
        const auto bad = [&](std::size_t k) {
            if (k == 5) {
                throw std::bad_alloc();
            }
            done.fetch_add(1);
        };
        CHECK_THROWS_AS(team.run(64, bad), std::bad_alloc);
        if (threads > 1) {
            CHECK(done.load() == 63);
        }
        done.store(0);
        team.run(64, [&](std::size_t) { done.fetch_add(1); });
        CHECK(done.load() == 64);
    }
}
