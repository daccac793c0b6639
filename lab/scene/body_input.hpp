// Deformable bodies of a scene, as its user describes them.
#pragma once

#include <string>
#include <vector>

#include "core/input/declare.hpp"

namespace proveta {

/// Nodes of a body whose motion is given.
struct HoldInput {
    std::string group;                           ///< of the mesh; empty: those in the box
    std::vector<double> from{0.0, 0.0, 0.0};     ///< corner of a box, m
    std::vector<double> to{0.0, 0.0, 0.0};       ///< opposite corner, m
    std::string axes = "xyz";                    ///< that are held
    std::vector<double> velocity{0.0, 0.0, 0.0}; ///< along these, m/s
};

/// A pressure on a body's skin.
struct BodyPressureInput {
    double pressure = 0.0; ///< Pa
    double ramp = 0.0;     ///< s
};

/// A deformable body: made by the program or read from a file, put into place, held.
struct BodyInput {
    std::string name;
    std::string shape = "box";
    std::vector<double> size{1.0, 1.0, 1.0};
    double radius = 0.1;
    double height = 0.1;
    std::vector<double> cells{4.0, 4.0, 4.0};
    std::string elements = "hexahedra";
    std::string file;
    double scale = 1.0;
    std::vector<double> position{0.0, 0.0, 0.0};
    std::vector<double> turned{0.0, 0.0, 0.0};
    std::vector<double> velocity{0.0, 0.0, 0.0};
    std::string law = "neo_hookean";
    double density = 1000.0;
    double young_modulus = 5e6;
    double poisson_ratio = 0.3;
    double yield_stress = 1e6;
    double hardening = 0.0;
    double mass_damping = 0.0;
    double stiffness_damping = 0.0;
    double thickness = 0.001;
    double friction = 0.5;
    double restitution = 0.5;
    std::string coupling = "area_distributed";
    std::vector<HoldInput> holds;
    std::vector<BodyPressureInput> pressures;
};

void declare(input::Visitor& v, HoldInput& hold);
void declare(input::Visitor& v, BodyPressureInput& pressure);
void declare(input::Visitor& v, BodyInput& body);

} // namespace proveta
