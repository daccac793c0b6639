// Specimens of others: sphere meshes as text.
#pragma once

#include <string>

#include "specimens/specimen.hpp"

namespace proveta {

/// How an imported mesh lies and what solid it fills. Lengths in m; 0: fitted to the spheres.
struct ImportOptions {
    char axis = 'z'; ///< the file's axis that becomes z
    std::string shape = "cylinder";
    double diameter = 0.0;
    double width = 0.0;
    double depth = 0.0;
    double height = 0.0;
    double scale = 1.0; ///< metres per unit of the file
};

/// Reads spheres from a file by its ending: `.csv`, `.txt`, `.xyzr` (lines `x y z r [group]`, any of comma, semicolon or space between,
/// optional heading, `#` comments), `.mdpa` (Kratos: Nodes, RADIUS, COHESIVE_GROUP), `.msh` (GiD ASCII: Coordinates, sphere Elements).
/// The spheres are centred on the axis and set on z = 0, with the fitted or given solid about their middle. Throws std::runtime_error
/// with file, line and reason.
Specimen import_specimen(const std::string& file, const ImportOptions& options);

/// Writes lines `x,y,z,r,group` in m with 17 significant digits.
void export_csv(const Specimen& specimen, const std::string& file);

} // namespace proveta
