#include "lab/scene/motion.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "core/input/column_heading.hpp"
#include "core/input/text_table.hpp"
#include "core/model.hpp"
#include "lab/scene/vectors.hpp"

namespace proveta {

using input::Unit;

void declare(input::Visitor& v, MotionInput& m) {
    v.choice("kind", m.kind,
             {{"fixed", "it stays where it is"},
              {"velocity", "constant velocity and spin"},
              {"expression", "velocity and spin as expressions of the time t in s"},
              {"table", "places over time from a CSV file, straight between its rows"},
              {"servo", "it goes along a direction until the particles press back with a force, and follows them"}},
             "how the surface moves");
    const auto is = [&](const char* kind) { return v.wants_all() || m.kind == kind; };
    if (is("velocity")) {
        v.numbers("velocity", m.velocity, 3, Unit::velocity, input::any_number(), "velocity x y z");
        v.numbers("spin", m.spin, 3, Unit::angular_velocity, input::any_number(), "spin about the axes x y z through the pivot");
    }
    if (is("expression")) {
        constexpr const char* meaning[2] = {"component of the velocity, m/s, an expression of t", "component of the spin, rad/s, the same"};
        constexpr const char* keys[2][3] = {{"velocity_x", "velocity_y", "velocity_z"}, {"spin_x", "spin_y", "spin_z"}};
        for (int c = 0; c < 3; ++c) {
            v.text(keys[0][c], m.velocity_of_time[c], meaning[0]);
        }
        for (int c = 0; c < 3; ++c) {
            v.text(keys[1][c], m.spin_of_time[c], meaning[1]);
        }
    }
    if (is("table")) {
        v.text("file", m.file,
               "CSV with a heading: t in s and any of x, y, z (how far the surface has gone, m) and wx, wy, wz (spin, rad/s)");
    }
    if (is("servo")) {
        v.number("force", m.force, Unit::force, input::above(0), "with which the surface presses along its direction");
        v.numbers("along", m.along, 3, Unit::none, input::any_number(), "direction of that force x y z, of any length");
        v.number("most_speed", m.most_speed, Unit::velocity, input::above(0), "fastest that it goes, while the force is far from reached");
    }
    if (m.kind != "fixed" || v.wants_all()) {
        v.number("begin", m.begin, Unit::time, input::at_least(0), "before that it rests");
        v.number_or_word("end", m.end, {{"never", "to the end of the scene"}}, Unit::time, input::at_least(0), "after that it rests");
    }
    if (is("velocity") || is("expression") || is("table")) {
        v.choice("about", m.about_what, {{"position", "the surface's own position"}, {"point", "the pivot given"}}, "what it spins about");
        if (v.wants_all() || m.about_what == "point") {
            v.numbers("pivot", m.about, 3, Unit::length, input::any_number(), "point that the spin is about, x y z; goes along with it");
        }
    }
}

namespace {

// An expression of t. muParser keeps a pointer to its variable: not to be moved.
class Expression {
  public:
    Expression(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {
        parser_.DefineConst("pi", std::numbers::pi);
        parser_.DefineVar("t", &t_);
        parser_.SetExpr(text_);
        int values = 0;
        parser_.Eval(values); // complains of what it cannot read now, not later
        if (values != 1) {
            throw mu::ParserError(fmt::format("{} values, apart by commas, where one is expected; decimals have a point", values));
        }
    }
    Expression(const Expression&) = delete;
    Expression& operator=(const Expression&) = delete;

    // Throws NumericalFailure where it has no value, as at a pole.
    double at(double t) {
        t_ = t;
        const double value = parser_.Eval();
        if (!std::isfinite(value)) {
            throw NumericalFailure(fmt::format("{} = \"{}\" is {} at t = {:.6g} s", name_, text_, value, t));
        }
        return value;
    }

  private:
    std::string name_, text_;
    double t_ = 0.0;
    mu::Parser parser_;
};

std::string path_of(const std::string& file, const std::string& folder) { return (std::filesystem::path(folder) / file).string(); }

// Places over time: t, and any of x, y, z, wx, wy, wz; what the table has not stays empty.
struct Places {
    std::vector<double> t;
    std::vector<double> value[6];
};

Places read_places(const std::string& file) {
    const input::TextTable table(file);
    constexpr const char* names[] = {"x", "y", "z", "wx", "wy", "wz"};
    std::vector<bool> used(table.columns().size(), false);
    const auto column = [&](const std::string& name, Unit unit) -> std::vector<double> {
        const auto found = input::match_column(table, {name, {name}, unit, 1.0});
        if (!found) {
            return {};
        }
        used[found->index] = true;
        auto values = table.numbers(found->index);
        for (std::size_t k = 0; k < values.size(); ++k) {
            values[k] *= found->factor;
            if (!std::isfinite(values[k])) {
                throw std::runtime_error(fmt::format("{}: line {}: {} is missing", file, table.line(k), name));
            }
        }
        return values;
    };
    Places out;
    out.t = column("t", Unit::time);
    if (out.t.size() < 2) {
        throw std::runtime_error(
            fmt::format("{}: needs a column \"t\" of two or more ascending times in s; it has {}", file, table.description()));
    }
    for (std::size_t k = 1; k < out.t.size(); ++k) {
        if (!(out.t[k] > out.t[k - 1])) {
            throw std::runtime_error(fmt::format("{}: line {}: the time {:.6g} s comes after {:.6g} s; times have to ascend", file,
                                                 table.line(k), out.t[k], out.t[k - 1]));
        }
    }
    for (int c = 0; c < 6; ++c) {
        out.value[c] = column(names[c], c < 3 ? Unit::length : Unit::angular_velocity);
    }
    for (std::size_t c = 0; c < used.size(); ++c) {
        if (!used[c]) {
            throw std::runtime_error(fmt::format("{}: column \"{}\" is none of t, x, y, z, wx, wy, wz", file, table.columns()[c].heading));
        }
    }
    if (table.columns().size() < 2) {
        throw std::runtime_error(file + ": has times but no column of what moves");
    }
    return out;
}

class Constant : public SurfaceMotion {
  public:
    explicit Constant(const SurfaceVelocity& v) : v_(v) {}
    SurfaceVelocity at(double, double, const Surface&, const Spheres&) override { return v_; }

  private:
    SurfaceVelocity v_;
};

class OfTime : public SurfaceMotion {
  public:
    explicit OfTime(const MotionInput& m)
        : x_("velocity_x", m.velocity_of_time[0]), y_("velocity_y", m.velocity_of_time[1]), z_("velocity_z", m.velocity_of_time[2]),
          wx_("spin_x", m.spin_of_time[0]), wy_("spin_y", m.spin_of_time[1]), wz_("spin_z", m.spin_of_time[2]) {}
    SurfaceVelocity at(double t, double dt, const Surface&, const Spheres&) override {
        const double middle = t + 0.5 * dt;
        return {{x_.at(middle), y_.at(middle), z_.at(middle)}, {wx_.at(middle), wy_.at(middle), wz_.at(middle)}};
    }

  private:
    Expression x_, y_, z_, wx_, wy_, wz_;
};

// Where a step ends, the surface is where the table says, whatever the step.
class Table : public SurfaceMotion {
  public:
    explicit Table(const std::string& file) : places_(read_places(file)) {}
    SurfaceVelocity at(double t, double dt, const Surface&, const Spheres&) override {
        SurfaceVelocity v;
        for (int c = 0; c < 3; ++c) {
            v.velocity[c] = (value(c, t + dt) - value(c, t)) / dt;
            v.spin[c] = value(c + 3, t + 0.5 * dt);
        }
        return v;
    }

  private:
    [[nodiscard]] double value(int c, double t) const {
        const auto& y = places_.value[c];
        const auto& times = places_.t;
        if (y.empty()) {
            return 0.0;
        }
        const auto after = std::upper_bound(times.begin(), times.end(), t);
        if (after == times.begin() || after == times.end()) {
            return after == times.begin() ? y.front() : y.back();
        }
        const auto k = static_cast<std::size_t>(after - times.begin());
        return y[k - 1] + (y[k] - y[k - 1]) * (t - times[k - 1]) / (times[k] - times[k - 1]);
    }

    Places places_;
};

// Goes by what the contacts' own stiffness says is lacking, over so many steps that they can follow; the bed behind them gives way more, so
// that it never goes too far. Nothing touching, it goes as fast as it may.
class Servo : public SurfaceMotion {
  public:
    explicit Servo(const MotionInput& m) : along_(vector(m.along).normalized()), force_(m.force), most_(m.most_speed) {}
    SurfaceVelocity at(double, double dt, const Surface& surface, const Spheres& spheres) override {
        constexpr double steps = 50.0;
        const double lacks = force_ + along_.dot(surface.sums.reaction);
        const double stiffness = surface.stiffness_along(along_, spheres);
        const double speed = stiffness > 0.0 ? std::clamp(lacks / (stiffness * steps * dt), -most_, most_) : most_;
        return {speed * along_, Vec3::Zero()};
    }

  private:
    Vec3 along_;
    double force_, most_;
};

// Another motion between two times.
class Timed : public SurfaceMotion {
  public:
    Timed(std::unique_ptr<SurfaceMotion> motion, double begin, double end) : motion_(std::move(motion)), begin_(begin), end_(end) {}
    SurfaceVelocity at(double t, double dt, const Surface& surface, const Spheres& spheres) override {
        return t >= begin_ && t < end_ ? motion_->at(t, dt, surface, spheres) : SurfaceVelocity{};
    }

  private:
    std::unique_ptr<SurfaceMotion> motion_;
    double begin_, end_;
};

std::unique_ptr<SurfaceMotion> untimed(const MotionInput& m, const std::string& folder) {
    if (m.kind == "expression") {
        return std::make_unique<OfTime>(m);
    }
    if (m.kind == "table") {
        return std::make_unique<Table>(path_of(m.file, folder));
    }
    if (m.kind == "servo") {
        return std::make_unique<Servo>(m);
    }
    return std::make_unique<Constant>(m.kind == "velocity" ? SurfaceVelocity{vector(m.velocity), vector(m.spin)} : SurfaceVelocity{});
}

} // namespace

void check_motion(const MotionInput& m, double duration, const std::string& folder, const std::string& source, const std::string& path,
                  input::Problems& problems) {
    if (m.begin >= duration && m.kind != "fixed") {
        problems.push_back({source, path + "/begin", fmt::format("{:.6g} s", m.begin),
                            fmt::format("a time before the scene's end, {:.6g} s", duration), ""});
    }
    if (m.kind == "expression") {
        const auto zero = [](const std::string& text) { return text == "0"; };
        if (std::all_of(std::begin(m.velocity_of_time), std::end(m.velocity_of_time), zero) &&
            std::all_of(std::begin(m.spin_of_time), std::end(m.spin_of_time), zero)) {
            problems.push_back({source, path, "an expression for none of its components", "velocity_x to spin_z, one of them at least",
                                "what stands still is \"kind\": \"fixed\""});
        }
        constexpr const char* names[] = {"velocity", "spin"};
        for (int k = 0; k < 6; ++k) {
            const std::string& text = k < 3 ? m.velocity_of_time[k] : m.spin_of_time[k - 3];
            const std::string name = fmt::format("{}_{}", names[k / 3], "xyz"[k % 3]);
            const char* expected = "an expression of t, such as \"0.1*sin(2*pi*50*t)\"";
            try {
                Expression expression(name, text);
                constexpr int looks = 1000;
                const double last = m.end.word.empty() ? std::min(m.end.number, duration) : duration;
                for (int n = 0; n <= looks; ++n) {
                    (void)expression.at(std::lerp(m.begin, std::max(m.begin, last), static_cast<double>(n) / looks));
                }
            } catch (const mu::ParserError& error) {
                problems.push_back({source, path + "/" + name, "\"" + text + "\"", expected, error.GetMsg()});
            } catch (const NumericalFailure& error) {
                problems.push_back({source, path + "/" + name, error.what(), "a finite value throughout the scene", ""});
            }
        }
    }
    if (m.kind == "table") {
        try {
            if (const double first = read_places(path_of(m.file, folder)).t.front(); first >= duration) {
                problems.push_back({source, path + "/file", fmt::format("\"{}\", which begins at {:.6g} s", m.file, first),
                                    fmt::format("a table that begins before the scene's end, {:.6g} s", duration), ""});
            }
        } catch (const std::exception& error) {
            problems.push_back({source, path + "/file", "\"" + m.file + "\"", "a table of places over time", error.what()});
        }
    }
    if (m.kind == "servo") {
        if (m.force <= 0.0 || m.most_speed <= 0.0) {
            problems.push_back({source, path, "a servo without force or most_speed", "both, above 0", ""});
        }
        if (vector(m.along).norm() < 1e-12) {
            problems.push_back({source, path + "/along", "a vector without length", "a direction", ""});
        }
    }
    if (m.end.word.empty() && m.end.number <= m.begin) {
        problems.push_back({source, path + "/end", fmt::format("{:.6g} s", m.end.number), "a time after begin", ""});
    }
}

std::unique_ptr<SurfaceMotion> make_motion(const MotionInput& m, const std::string& folder) {
    const double end = m.end.word.empty() ? m.end.number : std::numeric_limits<double>::infinity();
    return std::make_unique<Timed>(untimed(m, folder), m.begin, end);
}

} // namespace proveta
