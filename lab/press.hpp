// The machine around a specimen: what loads it, what holds it, and what its readings are taken over.
#pragma once

#include <vector>

#include "core/boundaries/platen.hpp"
#include "core/boundaries/pressure.hpp"
#include "core/coupling/deformable.hpp"
#include "specimens/shape.hpp"

namespace proveta {

struct Press {
    /// The first two load, the first from the lower end of their axis; any others stand still and hold the specimen's side.
    std::vector<Platen> platens;
    std::vector<Pressure> pressures; ///< all at the same value
    std::vector<Deformable> bodies;  ///< the first, if there is any, is a membrane: its pressure is that on the side
    bool area_now = false;           ///< stress is force over the mean section now: what the membrane encloses over the height
    double length = 0.0;             ///< between the loading platens at the start, m
    double area = 0.0;               ///< nominal area that stress is force over, m2
    double side_area = 0.0;          ///< that the holding platens cover, m2; 0 without any
    double sense = 1.0;              ///< +1: platens close, -1: they part
    Shape::Region inner;             ///< where stress and strain are averaged
    bool bands = true;               ///< gauges between bands along z and around the girth; else the averaged strain of the inner region
};

} // namespace proveta
