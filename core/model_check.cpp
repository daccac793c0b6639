// Whether a calculation still stands on its feet, and what to say when it does not.
#include <cmath>
#include <sstream>

#include "core/model.hpp"

namespace proveta {

namespace {

bool finite(const Vec3& v) { return std::isfinite(v.squaredNorm()); }

// Where it shows: the first sphere whose state is no number and how many there are, else the fastest.
std::string place(const Spheres& s) {
    std::size_t k = 0;
    std::size_t lost = 0;
    double fastest = -1.0;
    for (std::size_t n = 0; n < s.size(); ++n) {
        if (!finite(s.position.at(n)) || !finite(s.velocity.at(n))) {
            k = lost++ == 0 ? n : k;
        } else if (lost == 0 && s.velocity.at(n).squaredNorm() > fastest) {
            fastest = s.velocity.at(n).squaredNorm();
            k = n;
        }
    }
    const Vec3 at = s.position.at(k);
    std::ostringstream out;
    if (lost > 1) {
        out << lost << " of " << s.size() << " spheres, the first of them ";
    }
    out << "sphere " << k << " (radius " << s.radius[k] << " m)";
    if (finite(at)) {
        out << " at (" << at.x() << ", " << at.y() << ", " << at.z() << ") m";
    } else {
        const Vec3 start = s.start.at(k);
        out << ", which started at (" << start.x() << ", " << start.y() << ", " << start.z() << ") m";
    }
    return out.str();
}

} // namespace

// Before a search, which has no place for what is nowhere.
void Model::check_places() const {
    for (std::size_t k = 0; k < spheres.size(); ++k) {
        if (!finite(spheres.position.at(k))) {
            std::ostringstream out;
            out << "at step " << steps_ << " (time " << time_
                << " s) the calculation diverged: a place is no number any more; probable cause: a time step above the critical one, or a "
                   "load far above the strength; it shows at "
                << place(spheres);
            throw NumericalFailure(out.str());
        }
    }
}

// An unstable step makes energy out of nothing, more of it every step, long before anything stops being a number. What is looked at is
// energy made only: what gets lost is told in the report. An amount that no bond would notice says nothing, and nothing tells which that is
// where there are no spheres yet.
void Model::check() const {
    std::ostringstream what;
    const double made = -ledger_.residual();
    const double noticeable = materials.empty() ? 0.0 : 1e-9 * materials.front().young_modulus * std::pow(mean_radius_, 3);
    const double most = numerics_.fastest * mean_radius_ / dt_;
    if (!std::isfinite(ledger_.spent()) || !std::isfinite(fastest_)) {
        what << "a quantity is no number any more; probable cause: a time step above the critical one, or forces beyond all measure";
    } else if (noticeable > 0.0 && made > numerics_.energy_made * std::fmax(std::fabs(ledger_.given()), noticeable) && made > noticeable &&
               dt_ > 1e-3 * stable_) { // else nothing is stiff
        what << "the energy ledger shows " << made << " J made out of nothing, " << ledger_.given()
             << " J having been put in; probable cause: "
             << (dt_ > stable_ ? "a time step above the critical one" : "a scheme of integration that no step is small enough for")
             << " (the step is " << dt_ << " s, the bound " << stable_ << " s)";
    } else if (mean_radius_ > 0.0 && fastest_ > most) {
        what
            << "a sphere or platen runs away at " << fastest_ << " m/s, more than " << numerics_.fastest
            << " mean radii a step; probable cause: spheres pressed into each other at the start, a load far above the strength, or a time "
               "step above the critical one";
    } else {
        return;
    }
    std::ostringstream out;
    out << "at step " << steps_ << " (time " << time_ << " s) the calculation diverged: " << what.str();
    if (spheres.size() > 0) {
        out << "; it shows at " << place(spheres);
    }
    throw NumericalFailure(out.str());
}

} // namespace proveta
