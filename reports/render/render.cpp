#include "reports/render/render.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace proveta::report {

namespace {

using Eigen::Vector3d;

constexpr int fine = 2;         // pixels of the drawing along one of the picture
constexpr double margin = 0.04; // of the picture's height, around the frame
constexpr float nothing = -std::numeric_limits<float>::infinity();
const Vector3d light = Vector3d(-0.45, 0.65, 0.75).normalized(); // in the picture's axes: right, up, towards the eye

// Axes of a view: right, up and towards the eye.
struct Axes {
    explicit Axes(const View& view) {
        const double a = view.azimuth * std::numbers::pi / 180.0;
        const double e = view.elevation * std::numbers::pi / 180.0;
        right = Vector3d(std::cos(a), std::sin(a), 0.0);
        eye = Vector3d(std::sin(a) * std::cos(e), -std::cos(a) * std::cos(e), std::sin(e));
        up = eye.cross(right);
    }
    [[nodiscard]] Vector3d operator()(const Vector3d& p) const { return {right.dot(p), up.dot(p), eye.dot(p)}; }
    Vector3d right, up, eye;
};

class Canvas {
  public:
    Canvas(const Frame& frame, const View& view, int height) : axes_(view) {
        Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity());
        Vector3d high = -low;
        for (int corner = 0; corner < 8; ++corner) {
            const Vector3d p((corner & 1) != 0 ? frame.high.x() : frame.low.x(), (corner & 2) != 0 ? frame.high.y() : frame.low.y(),
                             (corner & 4) != 0 ? frame.high.z() : frame.low.z());
            low = low.cwiseMin(axes_(p));
            high = high.cwiseMax(axes_(p));
        }
        scale_ = fine * height * (1.0 - 2.0 * margin) / std::max(high.y() - low.y(), 1e-300);
        height_ = fine * height;
        width_ =
            fine * std::clamp(static_cast<int>(std::ceil(((high.x() - low.x()) * scale_ / fine + 2.0 * margin * height))), 1, 4 * height);
        middle_ = 0.5 * (low + high);
        cut_ = view.cut ? 0.0 : std::numeric_limits<double>::infinity();
        const auto n = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
        depth_.assign(n, nothing);
        colour_.assign(n, {1.0f, 1.0f, 1.0f});
    }

    void draw(const Ball& ball) {
        const Vector3d c = axes_(ball.centre) - middle_;
        if (c.z() - ball.radius > cut_) {
            return;
        }
        const double r2 = ball.radius * ball.radius;
        each_pixel(c, ball.radius, [&](std::size_t pixel, double x, double y) {
            const double dx = x - c.x();
            const double dy = y - c.y();
            const double deep = r2 - dx * dx - dy * dy;
            if (deep < 0.0) {
                return;
            }
            const double half = std::sqrt(deep);
            if (c.z() - half > cut_) {
                return;
            }
            const bool face = c.z() + half > cut_;
            const double z = face ? cut_ : c.z() + half;
            const Vector3d normal = face ? Vector3d::UnitZ() : Vector3d(Vector3d(dx, dy, half) / ball.radius);
            put(pixel, z, normal, ball.colour);
        });
    }

    void draw(const Disc& disc) {
        const Vector3d c = axes_(disc.centre) - middle_;
        Vector3d n = axes_(disc.normal);
        n = n.z() < 0.0 ? Vector3d(-n) : n;
        const double steep = std::max(n.z(), 0.05); // seen from its edge it still shows
        each_pixel(c, disc.radius, [&](std::size_t pixel, double x, double y) {
            const double dx = x - c.x();
            const double dy = y - c.y();
            const double dz = -(n.x() * dx + n.y() * dy) / steep;
            if (dx * dx + dy * dy + dz * dz <= disc.radius * disc.radius && c.z() + dz <= cut_) {
                put(pixel, c.z() + dz, n, disc.colour);
            }
        });
    }

    // Darkens what lies behind its surroundings, and averages the fine pixels.
    Image picture() {
        shade_hollows();
        Image image{width_ / fine, height_ / fine, {}};
        image.rgb.reserve(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                std::array<float, 3> sum{};
                for (int k = 0; k < fine * fine; ++k) {
                    const Colour& c = colour_[at(fine * x + k % fine, fine * y + k / fine)];
                    sum = {sum[0] + c.r, sum[1] + c.g, sum[2] + c.b};
                }
                for (const float channel : sum) {
                    const float mean = channel / (fine * fine);
                    image.rgb.push_back(static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(mean, 0.0f, 1.0f))));
                }
            }
        }
        return image;
    }

  private:
    [[nodiscard]] std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }

    // Calls use(pixel, x, y) for the pixels within a radius of a point, with their places in m.
    template <class Use> void each_pixel(const Vector3d& c, double radius, const Use& use) {
        const auto column = [&](double x) { return 0.5 * width_ + x * scale_; };
        const auto row = [&](double y) { return 0.5 * height_ - y * scale_; };
        const int x0 = std::max(0, static_cast<int>(std::floor(column(c.x() - radius))));
        const int x1 = std::min(width_ - 1, static_cast<int>(std::ceil(column(c.x() + radius))));
        const int y0 = std::max(0, static_cast<int>(std::floor(row(c.y() + radius))));
        const int y1 = std::min(height_ - 1, static_cast<int>(std::ceil(row(c.y() - radius))));
        for (int y = y0; y <= y1; ++y) {
            for (int x = x0; x <= x1; ++x) {
                use(at(x, y), (x + 0.5 - 0.5 * width_) / scale_, (0.5 * height_ - y - 0.5) / scale_);
            }
        }
    }

    void put(std::size_t pixel, double z, const Vector3d& normal, const Colour& c) {
        if (static_cast<float>(z) <= depth_[pixel]) {
            return;
        }
        depth_[pixel] = static_cast<float>(z);
        const auto lit = static_cast<float>(0.45 + 0.6 * std::max(0.0, normal.dot(light)));
        colour_[pixel] = {c.r * lit, c.g * lit, c.b * lit};
    }

    void shade_hollows() {
        const auto reach = static_cast<float>(0.02 * height_ / scale_); // depth that counts as deep, m
        const int step = std::max(1, height_ / 200);
        std::vector<float> shade(depth_.size(), 1.0f);
        for (int y = 0; y < height_; ++y) {
            for (int x = 0; x < width_; ++x) {
                const float here = depth_[at(x, y)];
                if (here == nothing) {
                    continue;
                }
                float covered = 0.0f;
                for (const auto& [dx, dy] : around) {
                    const int u = std::clamp(x + dx * step, 0, width_ - 1);
                    const int v = std::clamp(y + dy * step, 0, height_ - 1);
                    const float other = depth_[at(u, v)];
                    covered += other == nothing ? 0.0f : std::clamp((other - here) / reach, 0.0f, 1.0f);
                }
                shade[at(x, y)] = 1.0f - 0.55f * covered / static_cast<float>(around.size());
            }
        }
        for (std::size_t k = 0; k < shade.size(); ++k) {
            colour_[k] = {colour_[k].r * shade[k], colour_[k].g * shade[k], colour_[k].b * shade[k]};
        }
    }

    static constexpr std::array<std::pair<int, int>, 12> around{
        {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}, {2, 0}, {-2, 0}, {0, 2}, {0, -2}}};

    Axes axes_;
    int width_ = 0, height_ = 0; // of the fine drawing
    double scale_ = 0.0;         // fine pixels a metre
    double cut_ = 0.0;           // depth beyond which nothing is seen, m
    Vector3d middle_;
    std::vector<float> depth_;
    std::vector<Colour> colour_;
};

} // namespace

Image render(const Body& body, const Frame& frame, const View& view, int height) {
    Canvas canvas(frame, view, height);
    for (const auto& ball : body.balls) {
        canvas.draw(ball);
    }
    for (const auto& disc : body.discs) {
        canvas.draw(disc);
    }
    return canvas.picture();
}

} // namespace proveta::report
