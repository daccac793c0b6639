// Pixels, and how they become a PNG file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace proveta::report {

/// Red, green and blue, 0 to 1 each.
struct Colour {
    float r = 0.0f, g = 0.0f, b = 0.0f;
};

/// Rows of pixels from the top, 8 bits a channel: red, green, blue.
struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
};

/// An image as the bytes of a PNG file. Throws std::runtime_error.
std::string to_png(const Image& image);

/// Blue over green to yellow, of even steps to the eye and readable without colours (after Viridis); x from 0 to 1.
Colour sequential(double x);

/// Blue over pale grey to red, for what has a direction; x from -1 to 1.
Colour diverging(double x);

/// Pale grey to dark red; x from 0 to 1.
Colour damage_colour(double x);

} // namespace proveta::report
