// The energy ledger: where the work put into a specimen went.
#pragma once

#include <cmath>

namespace proveta {

/// All terms in J since the start of the test. Each is accumulated from its own mechanism, none by difference, so the residual is a
/// measure of what the calculation lost or made.
struct Ledger {
    double platens = 0.0;    ///< work of the platens on the specimen
    double pressure = 0.0;   ///< work of pressures on the specimen
    double body = 0.0;       ///< work of gravity since the start
    double initial = 0.0;    ///< kinetic and stored energy that the test began with
    double coupling = 0.0;   ///< made, or taken out where negative, by the way contact forces are shared out over deformable bodies
    double elastic = 0.0;    ///< stored in bonds, contacts and deformable bodies, now
    double kinetic = 0.0;    ///< of translation and rotation, now
    double damage = 0.0;     ///< dissipated by damage and failure of bonds
    double plastic = 0.0;    ///< by plastic shortening of bonds and plastic strain of bodies
    double friction = 0.0;   ///< by sliding
    double dashpots = 0.0;   ///< by local damping, and by that of bodies (4.72)
    double background = 0.0; ///< by background damping (5.18-5.19)

    [[nodiscard]] double spent() const { return elastic + kinetic + damage + plastic + friction + dashpots + background; }
    [[nodiscard]] double given() const { return platens + pressure + body + initial + coupling; }
    [[nodiscard]] double residual() const { return given() - spent(); }

    /// Residual over the largest amount of energy that went through the ledger; 0 for an empty ledger.
    [[nodiscard]] double relative_residual() const {
        const double works = std::fmax(std::fabs(platens + pressure), std::fabs(body));
        const double scale = std::fmax(works, std::fmax(initial, spent()));
        return scale > 0.0 ? residual() / scale : 0.0;
    }
};

} // namespace proveta
