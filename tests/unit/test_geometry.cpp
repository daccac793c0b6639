#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "core/contacts/cell_grid.hpp"
#include "core/geometry/hilbert.hpp"
#include "core/geometry/lanes.hpp"
#include "core/geometry/rows.hpp"
#include "specimens/random.hpp"
#include "specimens/shape.hpp"

using namespace proveta;

TEST_CASE("the Hilbert curve visits every cell once and only steps to neighbours") {
    constexpr std::uint32_t side = 8;
    std::vector<std::array<std::uint32_t, 3>> path(side * side * side, {side, side, side});
    for (std::uint32_t x = 0; x < side; ++x) {
        for (std::uint32_t y = 0; y < side; ++y) {
            for (std::uint32_t z = 0; z < side; ++z) {
                const auto key = hilbert_key({x, y, z}, 3);
                REQUIRE(key < path.size());
                REQUIRE(path[key][0] == side);
                path[key] = {x, y, z};
            }
        }
    }
    for (std::size_t k = 1; k < path.size(); ++k) {
        int distance = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            distance += std::abs(static_cast<int>(path[k][c]) - static_cast<int>(path[k - 1][c]));
        }
        REQUIRE(distance == 1);
    }
}

TEST_CASE("the cell search finds exactly the pairs that a double loop finds") {
    Random random(3, Stream::positions);
    VectorField at;
    std::vector<double> radius;
    for (int k = 0; k < 400; ++k) {
        at.push_back({random.uniform(), random.uniform(), random.uniform() * 3});
        radius.push_back(0.01 + 0.09 * random.uniform());
    }
    at.push_back({1000, -1000, 1000}); // a stray sphere must not cost memory
    radius.push_back(0.05);
    std::set<std::pair<int, int>> expected;
    for (std::size_t i = 0; i < radius.size(); ++i) {
        for (std::size_t j = i + 1; j < radius.size(); ++j) {
            if ((at.at(i) - at.at(j)).norm() <= 1.1 * (radius[i] + radius[j]) + 0.01) {
                expected.insert({static_cast<int>(i), static_cast<int>(j)});
            }
        }
    }
    std::set<std::pair<int, int>> found;
    for (const auto& p : find_pairs(at, radius, 1.1, 0.01)) {
        CHECK(found.insert({p.i, p.j}).second);
    }
    CHECK(found == expected);
    CHECK(find_pairs({}, {}, 1.0, 0.0).empty());
}

TEST_CASE("lanes select, load and gather like scalars") {
    constexpr auto n = lane_count<Lanes>();
    std::vector<double> values(4 * n);
    std::vector<std::int32_t> index(n);
    for (std::size_t k = 0; k < values.size(); ++k) {
        values[k] = static_cast<double>(k) - 3.5;
    }
    for (std::size_t k = 0; k < n; ++k) {
        index[k] = static_cast<std::int32_t>((7 * k + 1) % values.size());
    }
    const auto a = load<Lanes>(values.data());
    const auto b = gather<Lanes>(values.data(), index.data());
    const auto c = select(a > Lanes(0.0), a, b);
    for (std::size_t k = 0; k < n; ++k) {
        CHECK(in_lane(c, k) == (values[k] > 0.0 ? values[k] : values[static_cast<std::size_t>(index[k])]));
    }
}

TEST_CASE("the inverse square root is right to the last bits, alike for scalars and lanes") {
    constexpr auto n = lane_count<Lanes>();
    Random random(11, Stream::positions);
    for (int trial = 0; trial < 1000; ++trial) {
        double x[n];
        for (auto& v : x) {
            v = std::pow(10.0, 60.0 * random.uniform() - 30.0);
        }
        const auto y = inverse_sqrt(load<Lanes>(x));
        for (std::size_t k = 0; k < n; ++k) {
            CHECK(in_lane(y, k) == inverse_sqrt(x[k]));
            CHECK(std::fabs(inverse_sqrt(x[k]) * std::sqrt(x[k]) - 1.0) < 1e-15);
        }
    }
}

TEST_CASE("rows are turned into lanes and back, and pairs are added one after the other") {
    constexpr auto n = lane_count<Lanes>();
    alignas(64) double rows[16 * row_length];
    for (std::size_t k = 0; k < 16 * row_length; ++k) {
        rows[k] = std::sin(static_cast<double>(k));
    }
    Lanes turned[6];
    load_rows(rows + row_length, turned);
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t c = 0; c < 6; ++c) {
            CHECK(in_lane(turned[c], k) == rows[row_length * (k + 1) + c]);
        }
    }
    // Pairs that share spheres in every way, as the second of one and the first of the next.
    std::int32_t first[n];
    std::int32_t second[n];
    Lanes a[6];
    Lanes b[6];
    for (std::size_t c = 0; c < 6; ++c) {
        a[c] = turned[c] * 1.7;
        b[c] = turned[5 - c] * 0.3;
    }
    alignas(64) double expected[16 * row_length];
    std::copy(std::begin(rows), std::end(rows), expected);
    for (std::size_t k = 0; k < n; ++k) {
        first[k] = static_cast<std::int32_t>(k / 2);
        second[k] = static_cast<std::int32_t>(1 + k / 3);
        for (std::size_t c = 0; c < 6; ++c) {
            expected[row_length * static_cast<std::size_t>(first[k]) + c] += in_lane(a[c], k);
        }
        for (std::size_t c = 0; c < 6; ++c) {
            expected[row_length * static_cast<std::size_t>(second[k]) + c] += in_lane(b[c], k);
        }
    }
    add_rows(rows, first, second, a, b);
    CHECK(std::equal(std::begin(rows), std::end(rows), expected));
}

TEST_CASE("shapes keep spheres inside and measure depths") {
    Shape s;
    const Vec3 p = s.keep_inside({1.0, 1.0, 1.0}, 0.01);
    CHECK(s.depth_below_side(p) == Approx(0.01));
    CHECK(s.depth_below_end(p) == Approx(0.01));
    CHECK(s.volume() == Approx(std::numbers::pi * 0.075 * 0.075 * 0.3));
    Shape prism;
    prism.kind = ShapeKind::prism;
    CHECK(prism.keep_inside({-1.0, 0.0, 0.1}, 0.01).x() == Approx(-0.065));
}

TEST_CASE("the part of a segment inside a region agrees with counting points") {
    Random random(5, Stream::positions);
    for (const auto kind : {ShapeKind::cylinder, ShapeKind::prism}) {
        Shape shape;
        shape.kind = kind;
        const auto region = shape.inner(0.6, 0.5);
        for (int trial = 0; trial < 200; ++trial) {
            const auto point = [&] { return Vec3((random.uniform() - 0.5) * 0.2, (random.uniform() - 0.5) * 0.2, random.uniform() * 0.3); };
            const Vec3 a = point();
            const Vec3 b = point();
            int inside = 0;
            for (int k = 0; k < 2000; ++k) {
                inside += region.contains(a + (b - a) * ((k + 0.5) / 2000.0)) ? 1 : 0;
            }
            CHECK(region.fraction_inside(a, b) == Approx(inside / 2000.0).margin(1.5e-3));
        }
    }
}
