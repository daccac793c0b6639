// How a surface of a scene moves: by constants, by expressions of time, by a table, or by a servo that keeps a force.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/boundaries/surface.hpp"
#include "core/input/json.hpp"

namespace proveta {

/// The "motion" of a surface as its user describes it.
struct MotionInput {
    std::string kind = "fixed";
    std::vector<double> velocity{0.0, 0.0, 0.0}; ///< m/s
    std::vector<double> spin{0.0, 0.0, 0.0};     ///< rad/s
    std::string velocity_of_time[3]{"0", "0", "0"};
    std::string spin_of_time[3]{"0", "0", "0"};
    std::string file;
    double force = 0.0; ///< N
    std::vector<double> along{0.0, 0.0, -1.0};
    double most_speed = 0.0;                  ///< m/s
    double begin = 0.0;                       ///< s
    input::NumberOrWord end{0.0, "never"};    ///< s
    std::vector<double> about{0.0, 0.0, 0.0}; ///< m
    std::string about_what = "position";      ///< "position" of the surface, or the "point" `about`
};

void declare(input::Visitor& v, MotionInput& motion);

/// What is wrong with a motion beyond single values: expressions that do not parse or have no value at some time, tables that cannot be
/// read. duration: of the scene, s; path: the motion's JSON pointer.
void check_motion(const MotionInput& motion, double duration, const std::string& folder, const std::string& source, const std::string& path,
                  input::Problems& problems);

/// A motion at work. One object a surface, used in the order of time.
class SurfaceMotion {
  public:
    virtual ~SurfaceMotion() = default;
    /// Velocity of the surface over the step that begins at time t, s.
    virtual SurfaceVelocity at(double t, double dt, const Surface& surface, const Spheres& spheres) = 0;
};

/// Makes what `check_motion` found nothing wrong with. folder: where relative file names start.
std::unique_ptr<SurfaceMotion> make_motion(const MotionInput& motion, const std::string& folder);

} // namespace proveta
