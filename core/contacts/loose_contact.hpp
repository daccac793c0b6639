// Constants of one loose contact, as plain numbers: all that the compiled variants of the contact kernel see of it.
#pragma once

#include <cstdint>

namespace proveta {

/// Law of loose contacts (thesis 2.5.1, 2.5.2).
enum class ContactLaw : std::uint8_t { linear, hertz };

/// Constants of one contact. Stiffnesses in N/m and dashpots in N s/m for the linear law; for the Hertzian one those at an overlap of one
/// metre, N/m^(3/2) and N s/m^(5/4).
struct LooseContact {
    ContactLaw law = ContactLaw::linear;
    bool tension = false;
    double k_n = 0.0, k_t = 0.0;
    double c_n = 0.0, c_t = 0.0;
    double friction = 0.0;
    double rolling_arm = 0.0;     ///< eta_r R_r, m
    double reduced_inertia = 0.0; ///< of the relative spin, kg m2
    double reduced_mass = 0.0;    ///< kg
};

/// One step of loose contacts.
struct ContactStep {
    double elapsed;        ///< since the last forces, s
    double dt;             ///< that the forces will act for, s
    bool impacts = false;  ///< dashpots as `contact::lagging` and `contact::begun` have them
    bool overlaps = false; ///< the largest overlap is asked for
};

} // namespace proveta
