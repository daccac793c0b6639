// The energy ledger: where the work put into a specimen went.
#pragma once

#include <cmath>

namespace proveta {

/// All terms in J since the start of the test. Each is accumulated from its own mechanism, none by difference, so the residual is a
/// measure of what the calculation lost or made.
struct Ledger {
    double platens = 0.0;    ///< work of the platens on the specimen
    double pressure = 0.0;   ///< work of pressures on the specimen
    double elastic = 0.0;    ///< stored in bonds, contacts and platen contacts, now
    double kinetic = 0.0;    ///< of translation and rotation, now
    double damage = 0.0;     ///< dissipated by damage and failure of bonds
    double plastic = 0.0;    ///< by plastic shortening of bonds
    double friction = 0.0;   ///< by sliding
    double dashpots = 0.0;   ///< by local damping
    double background = 0.0; ///< by the non-viscous background damping (5.18-5.19)

    [[nodiscard]] double spent() const { return elastic + kinetic + damage + plastic + friction + dashpots + background; }
    [[nodiscard]] double work() const { return platens + pressure; }
    [[nodiscard]] double residual() const { return work() - spent(); }

    /// Residual over the largest amount of energy that went through the ledger; 0 for an empty ledger.
    [[nodiscard]] double relative_residual() const {
        const double scale = std::fmax(std::fabs(work()), spent());
        return scale > 0.0 ? residual() / scale : 0.0;
    }
};

} // namespace proveta
