// Pictures of spheres and cracks without a graphics card or a screen: every ball and disc is drawn exactly, pixel by pixel.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "reports/render/image.hpp"

namespace proveta::report {

struct Ball {
    Eigen::Vector3d centre;
    double radius;
    Colour colour;
};

/// A flat round plate, such as a crack.
struct Disc {
    Eigen::Vector3d centre;
    Eigen::Vector3d normal; ///< of length 1
    double radius;
    Colour colour;
};

struct Body {
    std::vector<Ball> balls;
    std::vector<Disc> discs;
};

/// A parallel view. Azimuth 0 looks along +y with x to the right and z up; both in degrees.
struct View {
    double azimuth = 30.0;
    double elevation = 15.0;
    bool cut = false; ///< everything nearer than the middle of `frame` is left out; balls that this cuts show a flat face
};

/// What a picture shows, m: all pictures of a series have one, so that they can be compared.
struct Frame {
    Eigen::Vector3d low, high;
};

/// Draws a body on white. height: of the picture in pixels; its width follows from the frame.
Image render(const Body& body, const Frame& frame, const View& view, int height);

} // namespace proveta::report
