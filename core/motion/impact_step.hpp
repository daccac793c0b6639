// The step that impacts ask for: how long the contacts last that are about to begin.
#pragma once

#include "core/boundaries/walls.hpp"
#include "core/contacts/contacts.hpp"

namespace proveta {

/// Duration of the impact of a contact in s that closes at `speed` m/s with an overlap in m, negative while it is apart, and how many steps
/// it wants; without damping, which makes impacts longer, by (2.65) and (A.19b).
///
/// What wants more steps is a dashpot: the more of its force there is the more it matters when it begins. With n (1 + xi) steps an impact
/// between n = 16 and n = 20 gives back restitutions of 0.1 to 1 to half a per cent and the largest overlap to two, whatever part of a
/// step it begins in (`proveta verify impact-steps`).
///
/// A contact whose springs hold more energy than its motion bears a load; it is no impact and asks for nothing.
double impact_step(const LooseContact& contact, double speed, double overlap, double steps);

/// The shortest such step of the listed contacts of spheres with each other, with surfaces and with deformable bodies, s; 1e300 where there
/// is none. skin: within which they are listed, m.
double impact_step(const Spheres& spheres, const Contacts& contacts, const Walls& walls, double skin, double steps);

} // namespace proveta
