#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "reports/figure.hpp"
#include "reports/render/render.hpp"

using namespace proveta::report;

namespace {

const Frame unit{{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}};
const View front{0.0, 0.0, false};
const Colour red{1.0f, 0.0f, 0.0f};
const Colour blue{0.0f, 0.0f, 1.0f};

// Share of the pixels for which is(r, g, b) holds.
template <class Is> double share(const Image& image, const Is& is) {
    std::size_t n = 0;
    for (std::size_t k = 0; k + 2 < image.rgb.size(); k += 3) {
        n += is(image.rgb[k], image.rgb[k + 1], image.rgb[k + 2]) ? 1 : 0;
    }
    return static_cast<double>(n) / (static_cast<double>(image.rgb.size()) / 3.0);
}

bool reddish(int r, int g, int b) { return r > 60 && g < 0.5 * r && b < 0.5 * r; }
bool bluish(int r, int g, int b) { return b > 60 && r < 0.5 * b && g < 0.5 * b; }

} // namespace

TEST_CASE("pictures: a ball covers its circle, and nothing else is drawn") {
    const Image image = render({{{{0.0, 0.0, 0.0}, 0.5, red}}, {}}, unit, front, 400);
    REQUIRE(image.rgb.size() == 3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    CHECK(image.height == 400);
    const double side = 2.0 / 0.92; // of the square picture, m: the frame and its margin
    CHECK(share(image, reddish) == Approx(std::numbers::pi * 0.25 / (side * side)).epsilon(0.02));
    CHECK(share(image, [](int r, int g, int b) { return r == 255 && g == 255 && b == 255; }) > 0.8);
}

TEST_CASE("pictures: what is nearer hides what is behind, from whichever side one looks") {
    const Body body{{{{0.0, -0.5, 0.0}, 0.4, red}, {{0.0, 0.5, 0.0}, 0.4, blue}}, {}};
    const Image before = render(body, unit, front, 200);
    CHECK(share(before, bluish) == 0.0);
    CHECK(share(before, reddish) > 0.05);
    const Image behind = render(body, unit, {180.0, 0.0, false}, 200);
    CHECK(share(behind, reddish) == 0.0);
    CHECK(share(behind, bluish) > 0.05);
    const Image from_the_side = render(body, unit, {90.0, 0.0, false}, 200);
    CHECK(share(from_the_side, reddish) == Approx(share(from_the_side, bluish)).epsilon(0.1));
}

TEST_CASE("pictures: a cut takes away what is in front of the middle and shows a flat face") {
    const Body body{{{{0.0, -0.6, 0.0}, 0.3, red}, {{0.0, 0.0, 0.0}, 0.5, blue}}, {}};
    const Image image = render(body, unit, {0.0, 0.0, true}, 200);
    CHECK(share(image, reddish) == 0.0);
    // The face faces the eye everywhere: one shade, but for the shadow of hollows at its rim.
    const auto middle = 3 * static_cast<std::size_t>(100 * image.width + image.width / 2);
    const auto off = 3 * static_cast<std::size_t>(100 * image.width + image.width / 2 + 30);
    CHECK(image.rgb[middle + 2] == image.rgb[off + 2]);
    CHECK(share(image, bluish) == Approx(std::numbers::pi * 0.25 * 0.46 * 0.46).epsilon(0.04));
}

TEST_CASE("pictures: a disc is seen as an ellipse") {
    const double slant = std::numbers::pi / 3.0;
    const Disc disc{{0.0, 0.0, 0.0}, {0.0, -std::cos(slant), std::sin(slant)}, 0.6, red};
    const Image image = render({{}, {disc}}, unit, front, 400);
    CHECK(share(image, reddish) == Approx(std::numbers::pi * 0.36 * std::cos(slant) * 0.46 * 0.46).epsilon(0.03));
}

TEST_CASE("pictures: PNG, colours and base 64") {
    const std::string png = to_png(render({{{{0.0, 0.0, 0.0}, 0.5, red}}, {}}, unit, front, 64));
    CHECK(png.substr(0, 8) == "\x89PNG\r\n\x1a\n");
    CHECK(png.size() > 300);
    // Lighter with every step: read without colours they still have an order.
    float last = 0.0f;
    for (const double x : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) {
        const Colour c = sequential(x);
        const float light = 0.3f * c.r + 0.59f * c.g + 0.11f * c.b;
        CHECK(light > last);
        last = light;
    }
    CHECK(sequential(7.0).r == sequential(1.0).r);
    CHECK(sequential(std::nan("")).b == sequential(0.0).b);
    CHECK(base64("") == "");
    CHECK(base64("f") == "Zg==");
    CHECK(base64("fo") == "Zm8=");
    CHECK(base64("foobar") == "Zm9vYmFy");
}
