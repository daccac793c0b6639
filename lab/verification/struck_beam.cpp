#include "lab/verification/struck_beam.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/solids/solid_shapes.hpp"

namespace proveta::verification {

namespace {

constexpr double shear_share = 5.0 / 6.0; // of a rectangular section

// A mode of the beam as an oscillator: seen from the middle.
struct Mode {
    double frequency, mass;          // rad/s, kg
    double cosine = 1.0, sine = 0.0; // of its angle in a step
    double place = 0.0, speed = 0.0;

    void set_step(double dt) {
        cosine = std::cos(frequency * dt);
        sine = std::sin(frequency * dt);
    }
    void turn() {
        const double then = cosine * place + sine / frequency * speed;
        speed = cosine * speed - frequency * sine * place;
        place = then;
    }
};

Mode make_mode(const StruckBeam& beam, BeamTheory theory, int n) {
    const double line_mass = beam.density * beam.side * beam.side;
    if (theory == BeamTheory::slender) {
        return {beam.frequency(n), 0.5 * line_mass * beam.length};
    }
    // c w^4 - b w^2 + w_slender^2 = 0; the section's rotation stands to the deflection as (k - c w^2 / (r^2 k)).
    const double wave = n * std::numbers::pi / beam.length;
    const double r2 = beam.side * beam.side / 12.0;
    const double shear = shear_share * beam.young / (2.0 * (1.0 + beam.poisson));
    const double c = beam.density * r2 / shear;
    const double b = 1.0 + r2 * wave * wave * (1.0 + beam.young / shear);
    const double slender = beam.frequency(n) * beam.frequency(n);
    const double square = 2.0 * slender / (b + std::sqrt(b * b - 4.0 * c * slender));
    const double rotation = wave - beam.density * square / (shear * wave);
    return {std::sqrt(square), 0.5 * line_mass * beam.length * (1.0 + r2 * rotation * rotation)};
}

// Nodes in the middle of the beam's length, those nearest to its axis.
std::vector<std::uint32_t> middle_nodes(const SolidMesh& mesh) {
    const auto off = [](const Vec3& p) { return std::fabs(p.x()) + std::fabs(p.z()); };
    double least = 1e300;
    for (const auto& p : mesh.node) {
        least = std::min(least, off(p));
    }
    std::vector<std::uint32_t> out;
    for (std::uint32_t k = 0; k < mesh.node.size(); ++k) {
        if (off(mesh.node[k]) < least + 1e-9) {
            out.push_back(k);
        }
    }
    return out;
}

NodeHold hold(const SolidMesh& mesh, const std::string& group, std::array<bool, 3> axes) {
    const auto found = std::find_if(mesh.groups.begin(), mesh.groups.end(), [&](const auto& g) { return g.name == group; });
    return {group, found->node, axes};
}

} // namespace

double StruckBeam::sphere_mass() const { return density * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius; }

double StruckBeam::hertz_stiffness() const { return 4.0 / 3.0 * young / (2.0 * (1.0 - poisson * poisson)) * std::sqrt(radius); }

double StruckBeam::frequency(int n) const {
    const double wave = n * std::numbers::pi / length;
    return wave * wave * std::sqrt(young * side * side / (12.0 * density));
}

void ImpactHistory::add(double t, double f, double w) {
    time.push_back(t);
    force.push_back(f);
    deflection.push_back(w);
}

std::vector<std::pair<double, double>> ImpactHistory::contacts() const {
    std::vector<std::pair<double, double>> out;
    bool on = false;
    for (std::size_t k = 0; k < time.size(); ++k) {
        if (force[k] > 0.0 && !on) {
            out.emplace_back(time[k], time[k]);
        }
        on = force[k] > 0.0;
        if (on) {
            out.back().second = time[k];
        }
    }
    return out;
}

double ImpactHistory::contact_time() const {
    const auto all = contacts();
    return all.empty() ? 0.0 : all[0].second - all[0].first;
}

double ImpactHistory::peak() const {
    const auto all = contacts();
    double highest = 0.0;
    for (std::size_t k = 0; k < time.size() && !all.empty() && time[k] <= all[0].second; ++k) {
        highest = std::max(highest, force[k]);
    }
    return highest;
}

double ImpactHistory::impulse() const {
    const auto all = contacts();
    double sum = 0.0;
    for (std::size_t k = 1; k < time.size() && !all.empty() && time[k - 1] <= all[0].second; ++k) {
        sum += 0.5 * (force[k] + force[k - 1]) * (time[k] - time[k - 1]);
    }
    return sum;
}

double ImpactHistory::deepest() const { return *std::max_element(deflection.begin(), deflection.end()); }

double ImpactHistory::force_at(double t) const {
    const auto after = std::upper_bound(time.begin(), time.end(), t);
    if (after == time.begin() || after == time.end()) {
        return 0.0;
    }
    const auto k = static_cast<std::size_t>(after - time.begin());
    const double part = (t - time[k - 1]) / (time[k] - time[k - 1]);
    return (1.0 - part) * force[k - 1] + part * force[k];
}

double ImpactHistory::distance_to(const ImpactHistory& other, double until) const {
    constexpr int points = 1000;
    double sum = 0.0;
    for (int k = 0; k < points; ++k) {
        const double t = until * k / points;
        const double difference = force_at(t) - other.force_at(t);
        sum += difference * difference;
    }
    return std::sqrt(sum / points) / other.peak();
}

ImpactHistory modal_solution(const StruckBeam& beam, BeamTheory theory, int modes, double dt, double until) {
    std::vector<Mode> mode;
    for (int k = 0; k < modes; ++k) { // even modes have a node in the middle
        mode.push_back(make_mode(beam, theory, 2 * k + 1));
        mode.back().set_step(dt);
    }
    const double stiffness = beam.hertz_stiffness();
    const double mass = beam.sphere_mass();
    double sphere = 0.0;
    double speed = beam.speed;
    ImpactHistory out;
    for (double t = 0.0; t < until; t += dt) {
        double deflection = 0.0;
        for (const auto& m : mode) {
            deflection += m.place;
        }
        const double force = stiffness * std::pow(std::max(sphere - deflection, 0.0), 1.5);
        out.add(t, force, deflection);
        speed -= force / mass * dt;
        sphere += speed * dt;
        for (auto& m : mode) {
            m.speed += force / m.mass * dt;
            m.turn();
        }
    }
    return out;
}

Model struck_beam_model(const StruckBeam& beam, int nx, int ny, int nz, Coupling coupling) {
    SolidMaterial steel;
    steel.density = beam.density;
    steel.young_modulus = beam.young;
    steel.poisson_ratio = beam.poisson;
    Material m;
    m.density = beam.density;
    m.young_modulus = beam.young;
    m.poisson_ratio = beam.poisson;
    m.contact_law = ContactLaw::hertz;
    m.contact_restitution = 1.0;
    Solid solid("beam", box_mesh({beam.length, beam.side, beam.side}, nx, ny, nz, false), steel);
    solid.holds = {hold(solid.mesh(), "x-", {false, false, true}), hold(solid.mesh(), "x+", {false, false, true})};
    Spheres s;
    s.add({0.0, 0.0, 0.5 * beam.side + beam.radius}, beam.radius, beam.density);
    s.velocity.set(0, {0.0, 0.0, -beam.speed});
    std::vector<double> weight;
    Bonds none = make_bonds(s, {m}, {}, {0}, weight);
    Numerics numerics;
    numerics.damping = {0.0, 0.0};
    // Overlaps are taken to grow by as much as the skin, and real ones are below a ten-thousandth of the radius: a skin of the usual size
    // would make contacts look far stiffer than they are and the step needlessly short.
    numerics.skin = 1e-3;
    return {std::move(s), {m}, std::move(none), std::move(weight), Walls({}, {}, {Deformable(std::move(solid), m, 0.0, coupling, 1.0)}),
            numerics};
}

ImpactHistory run_impact(const StruckBeam& beam, Model& model, double until) {
    const Deformable& body = model.walls.bodies[0];
    const auto middle = middle_nodes(body.solid.mesh());
    ImpactHistory out;
    while (model.time() < until) {
        double deflection = 0.0;
        for (const auto k : middle) {
            deflection -= (body.solid.position[k] - body.solid.mesh().node[k]).z() / static_cast<double>(middle.size());
        }
        const double t = model.time();
        model.step({}, true);
        double force = 0.0;
        for (const auto& touch : body.touches[0]) {
            force += touch.force.z();
        }
        // Touching without overlap exerts round-off: less than at 1e-10 radii.
        out.add(t, force > 1e-15 * beam.hertz_stiffness() * std::pow(beam.radius, 1.5) ? force : 0.0, deflection);
    }
    return out;
}

} // namespace proveta::verification
