#include "specimens/filling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "core/model.hpp"
#include "specimens/random.hpp"

namespace proveta {

namespace {

constexpr double density = 2650.0; // of quartz, kg/m3: only its weight against the seating pressure matters
constexpr double gravity = 9.81;   // m/s2
constexpr int steps_per_look = 100;

Material grain_material(const FillingPlan& plan) {
    Material m;
    m.name = "filling";
    m.density = density;
    m.young_modulus = plan.modulus;
    m.poisson_ratio = 0.25;
    m.contact_law = ContactLaw::hertz;
    m.contact_restitution = 0.2;
    m.mu_d = plan.friction;
    return m;
}

// Spheres around grains, found by the column of space that they stand in.
class Columns {
  public:
    Columns(double diameter, double widest) : half_(0.5 * diameter), cell_(2.0 * widest) {
        across_ = static_cast<int>(diameter / cell_) + 1;
        standing_.resize(static_cast<std::size_t>(across_) * static_cast<std::size_t>(across_));
    }

    void put(const Vec3& centre, double radius) { standing_[at(index(centre.x()), index(centre.y()))].push_back({centre, radius}); }

    // Height at which a sphere that comes from above meets the others or the ground.
    [[nodiscard]] double lowest(double x, double y, double radius) const {
        double z = radius;
        for (int i = std::max(0, index(x) - 1); i <= std::min(across_ - 1, index(x) + 1); ++i) {
            for (int j = std::max(0, index(y) - 1); j <= std::min(across_ - 1, index(y) + 1); ++j) {
                for (const auto& other : standing_[at(i, j)]) {
                    const double reach = radius + other.radius;
                    const double square = reach * reach - std::pow(other.centre.x() - x, 2) - std::pow(other.centre.y() - y, 2);
                    z = square > 0.0 ? std::max(z, other.centre.z() + std::sqrt(square)) : z;
                }
            }
        }
        return z;
    }

  private:
    struct Standing {
        Vec3 centre;
        double radius;
    };
    [[nodiscard]] int index(double x) const { return std::clamp(static_cast<int>((x + half_) / cell_), 0, across_ - 1); }
    [[nodiscard]] std::size_t at(int i, int j) const {
        return static_cast<std::size_t>(i) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(j);
    }

    double half_, cell_;
    int across_ = 1;
    std::vector<std::vector<Standing>> standing_;
};

// Grains as a model holds them; each sphere's id is its grain's number in the plan.
struct Bodies {
    Spheres spheres;
    Clusters clusters;

    Bodies() { spheres.packed = false; }
};

// Step for contacts between two equal grains that overlap as much as grains are thought to. The model's bound reckons with every
// neighbour that might touch and would be ten times shorter; that this one is not too long is seen by the energy balance.
double step_of(const LoosePair& pair, const LooseBody& body) {
    constexpr double overlap = 0.02; // over the radius
    constexpr double share = 0.12;   // of the time in which a contact swings by one radian
    const LooseContact contact = loose_contact(pair, body, body, std::numbers::pi * body.radius * body.radius);
    return share * std::sqrt(body.mass / stiffness_at(contact, overlap * body.radius).k_n);
}

// Mass of all grains, kg.
double mass_of(const Spheres& spheres, const Clusters& clusters) {
    const auto alone = spheres.mass.begin() + static_cast<std::ptrdiff_t>(clusters.alone(spheres));
    return std::accumulate(clusters.mass.begin(), clusters.mass.end(), std::accumulate(spheres.mass.begin(), alone, 0.0));
}

// A filling on its way.
class Work {
  public:
    Work(const FillingPlan& plan, std::uint64_t seed, const std::function<void(double)>& progress);

    void fall();
    void take_away();
    void press();
    [[nodiscard]] Filling result() const;

  private:
    void let_in(const Grain& grain, const Vec3& at, const rotation::Quaternion& attitude);
    [[nodiscard]] Numerics numerics() const;
    [[nodiscard]] Model model_of(const std::vector<Platen>& more) const;
    [[nodiscard]] std::vector<double> tops() const;
    [[nodiscard]] double rms_speed(const Model& model) const;
    void watch(const Model& model, double expected, double from, double to) const;
    void keep(const Model& model);

    const FillingPlan& plan_;
    const std::function<void(double)>& progress_;
    Material material_;
    Bodies bodies_;
    double mass_ = 0.0;  // of the grains, kg
    double size_ = 0.0;  // of a grain of mean volume, m
    double speed_ = 0.0; // that nobody exceeds, m/s
    double step_ = 0.0;  // s
    double height_ = 0.0;
    FillingReport report_;
};

Work::Work(const FillingPlan& plan, std::uint64_t seed, const std::function<void(double)>& progress)
    : plan_(plan), progress_(progress), material_(grain_material(plan)) {
    constexpr double fall = 4.0; // over the size: nobody gets faster than by a fall from there, so that nobody is hit hard
    const auto centres = let_down(plan, seed);
    Random random(seed, Stream::attitudes);
    step_ = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < plan.grains.size(); ++k) {
        let_in(plan.grains[k], centres[k], any_attitude(random));
    }
    mass_ = mass_of(bodies_.spheres, bodies_.clusters);
    size_ = std::cbrt(6.0 * mass_ / (std::numbers::pi * density * static_cast<double>(plan.grains.size())));
    speed_ = std::sqrt(2.0 * gravity * fall * size_);
    report_.placed = plan.grains.size();
}

void Work::let_in(const Grain& grain, const Vec3& at, const rotation::Quaternion& attitude) {
    Spheres& spheres = bodies_.spheres;
    const std::size_t from = spheres.size();
    const auto number = from == 0 ? 0 : spheres.id.back() + 1;
    if (grain.form < 0) {
        spheres.add(at, 0.5 * grain.size, density);
    } else {
        bodies_.clusters.add(spheres, scaled(plan_.forms[static_cast<std::size_t>(grain.form)], grain.size), density, at, attitude);
    }
    double radius = 0.0;
    for (std::size_t s = from; s < spheres.size(); ++s) {
        spheres.id[s] = number;
        radius = std::max(radius, spheres.radius[s]);
    }
    step_ = std::min(step_, step_of(loose_pair(material_, material_), {radius, spheres.mass[from], spheres.inertia[from]}));
}

Numerics Work::numerics() const {
    Numerics n;
    n.time_step = step_;
    n.refuse_unstable = false;
    n.energy_made = std::numeric_limits<double>::infinity(); // spheres that grow bring energy with them
    n.skin = 0.3;
    n.fastest = 0.5;
    n.gravity = Vec3(0.0, 0.0, -gravity);
    const double rate = gravity / speed_;
    n.damping = {rate, rate, true};
    return n;
}

// The grains in the cylinder, the inside of a ring, on its base. more: platens besides.
Model Work::model_of(const std::vector<Platen>& more) const {
    const double radius = 0.5 * plan_.diameter;
    std::vector<Platen> walls{make_wall(bodies_.spheres, ring_face(radius), -radius, material_, 0.0),
                              make_wall(bodies_.spheres, Face{}, 0.0, material_, 0.0)};
    walls.insert(walls.end(), more.begin(), more.end());
    std::vector<double> weight;
    Bonds none = make_bonds(bodies_.spheres, {material_}, {}, std::vector<std::uint8_t>(bodies_.spheres.size(), 0), weight);
    return {bodies_.spheres, {material_}, std::move(none), std::move(weight), Walls(std::move(walls)), numerics(), bodies_.clusters};
}

// Root mean square speed at the last measured step, m/s.
double Work::rms_speed(const Model& model) const { return std::sqrt(2.0 * model.ledger().kinetic / mass_); }

// Looks after a model at measured steps. expected: time that the stage takes, s; from, to: its part of the whole.
void Work::watch(const Model& model, double expected, double from, double to) const {
    constexpr double patience = 20.0;
    constexpr double balance = 0.02; // energy that may come from nowhere, over all that went through
    if (model.time() > patience * expected) {
        throw NumericalFailure(fmt::format("the particles of the specimen come to no rest: after {:.3g} s their root mean square speed is "
                                           "still {:.3g} m/s",
                                           model.time(), rms_speed(model)));
    }
    if (std::fabs(model.ledger().relative_residual()) > balance) {
        throw NumericalFailure(
            fmt::format("the filling of the specimen lost its balance of energy after {} steps of {:.3g} s: {:.2g} of it "
                        "comes from nowhere",
                        model.steps(), model.dt(), model.ledger().relative_residual()));
    }
    if (progress_) {
        progress_(from + (to - from) * std::min(1.0, model.time() / expected));
    }
}

// Takes the grains over from a model, for the next one to start from.
void Work::keep(const Model& model) {
    bodies_.spheres = model.spheres;
    bodies_.clusters = model.clusters;
    bodies_.spheres.start = bodies_.spheres.position;
    bodies_.clusters.start = bodies_.clusters.position;
    report_.steps += model.steps();
    report_.time += model.time();
    report_.rms_speed = rms_speed(model);
}

void Work::fall() {
    Model model = model_of({});
    const auto top = tops();
    const double expected = *std::max_element(top.begin(), top.end()) / speed_;
    do {
        for (int k = 1; k <= steps_per_look; ++k) {
            model.step({0.0, 0.0}, k == steps_per_look);
        }
        watch(model, expected, 0.0, 0.7);
    } while (model.time() < size_ / speed_ || rms_speed(model) > 0.01 * speed_);
    keep(model);
}

// Highest point of each grain of the plan, m; of those taken away minus infinity.
std::vector<double> Work::tops() const {
    std::vector<double> top(plan_.grains.size(), -std::numeric_limits<double>::infinity());
    for (std::size_t s = 0; s < bodies_.spheres.size(); ++s) {
        double& highest = top[static_cast<std::size_t>(bodies_.spheres.id[s])];
        highest = std::max(highest, bodies_.spheres.position.z[s] + bodies_.spheres.radius[s]);
    }
    return top;
}

// The top of what is left is rough; pressing will level it by about the part of a grain that may stand out.
void Work::take_away() {
    constexpr double out = 0.5; // over the size
    const auto top = tops();
    const double limit = plan_.height + out * size_;
    const Bodies all = std::move(bodies_);
    bodies_ = Bodies();
    const auto stays = [&](std::size_t s) { return top[static_cast<std::size_t>(all.spheres.id[s])] <= limit; };
    for (std::size_t s = 0; s < all.clusters.alone(all.spheres); ++s) {
        if (stays(s)) {
            bodies_.spheres.append(all.spheres, s);
        }
    }
    for (std::size_t b = 0; b < all.clusters.size(); ++b) {
        if (stays(all.clusters.first[b])) {
            bodies_.clusters.append(bodies_.spheres, all.clusters, all.spheres, b);
        }
    }
    report_.taken_away = static_cast<std::size_t>(std::count_if(top.begin(), top.end(), [&](double t) { return t > limit; }));
    mass_ = mass_of(bodies_.spheres, bodies_.clusters);
}

// The top platen is a plate of some mass under a dead load, which makes it approach and swing in smoothly; it goes slowly.
void Work::press() {
    const auto top = tops();
    Face down;
    down.inward = -1.0;
    Model model = model_of({make_wall(bodies_.spheres, down, *std::max_element(top.begin(), top.end()), material_, 0.0)});
    const double load = plan_.pressure * 0.25 * std::numbers::pi * plan_.diameter * plan_.diameter;
    const double plate = 0.1 * mass_;
    const double fastest = 0.05 * speed_;
    const Platen& platen = model.walls.platens.back();
    const double slowing = 10.0 * gravity / speed_; // viscous, 1/s, so that the plate does not go on swinging on the bed
    double speed = 0.0;                             // downwards
    double carried = 0.0;                           // mean load since the last look, N
    do {
        carried = 0.0;
        for (int k = 1; k <= steps_per_look; ++k) {
            speed = std::clamp(speed + ((load - platen.load()) / plate - slowing * speed) * model.dt(), -fastest, fastest);
            model.step({0.0, 0.0, -speed}, k == steps_per_look);
            carried += platen.load() / steps_per_look;
        }
        watch(model, size_ / fastest, 0.7, 1.0);
        // Single stones may go on rocking, by less than a test will move them.
    } while (rms_speed(model) > 5e-4 * speed_ || std::fabs(load - carried) > 0.005 * load);
    height_ = platen.position;
    report_.pressure = plan_.pressure * carried / load;
    keep(model);
}

Filling Work::result() const {
    Filling out;
    out.height = height_;
    out.forms = plan_.forms;
    out.report = report_;
    const auto& spheres = bodies_.spheres;
    const auto& clusters = bodies_.clusters;
    for (std::size_t b = 0; b < clusters.size(); ++b) {
        const Grain& grain = plan_.grains[static_cast<std::size_t>(spheres.id[clusters.first[b]])];
        out.stones.push_back({grain.form, grain.size, clusters.position[b], clusters.turning[b].attitude});
    }
    for (std::size_t s = 0; s < clusters.alone(spheres); ++s) {
        out.spheres.centre.push_back(spheres.position.at(s));
        out.spheres.radius.push_back(spheres.radius[s]);
    }
    return out;
}

} // namespace

std::vector<Vec3> let_down(const FillingPlan& plan, std::uint64_t seed) {
    constexpr int tries = 100;
    double widest = 0.0;
    for (const auto& grain : plan.grains) {
        widest = std::max(widest, plan.reach(grain));
    }
    if (2.0 * widest > plan.diameter) {
        throw std::invalid_argument(fmt::format("a grain is {:.4g} m long, more than the cylinder is wide", 2.0 * widest));
    }
    Random random(seed, Stream::positions);
    Columns columns(plan.diameter, widest);
    std::vector<Vec3> out;
    for (const auto& grain : plan.grains) {
        const double radius = plan.reach(grain);
        Vec3 best(0.0, 0.0, std::numeric_limits<double>::infinity());
        for (int k = 0; k < tries; ++k) {
            const double way = (0.5 * plan.diameter - radius) * std::sqrt(random.uniform());
            const double angle = 2.0 * std::numbers::pi * random.uniform();
            const double x = way * std::cos(angle);
            const double y = way * std::sin(angle);
            const double z = columns.lowest(x, y, radius);
            best = z < best.z() ? Vec3(x, y, z) : best;
        }
        columns.put(best, radius);
        out.push_back(best);
    }
    return out;
}

Filling fill(const FillingPlan& plan, std::uint64_t seed, const std::function<void(double)>& progress) {
    Work work(plan, seed, progress);
    work.fall();
    if (plan.level) {
        work.take_away();
    }
    work.press();
    return work.result();
}

} // namespace proveta
