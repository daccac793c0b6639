// Specimens of others: sphere meshes from files.
#pragma once

#include <string>
#include <vector>

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
    double scale = 0.0;    ///< metres per unit of the file; 0: what the file says, else 1
    std::string columns{}; ///< of a table, "x,y,z,r"; empty: by its headings
};

/// A specimen, and what its reader has to tell.
struct Imported {
    Specimen specimen;
    std::vector<std::string> notes;    ///< what was read as what
    std::vector<std::string> warnings; ///< what was not used, or looks wrong
};

/// Reads spheres from a file by its ending: `.csv`, `.txt`, `.xyzr`, `.dat` (tables, see text_table.hpp), `.mdpa` (Kratos), `.msh` (GiD,
/// ASCII and binary). The spheres are centred on the axis and set on z = 0, with the fitted or given solid about their middle. Throws
/// std::runtime_error with file, line and reason; also where the spheres cannot be a specimen of that shape: two in one place, one far
/// away, more matter than room, a section that is not round.
Imported import_specimen(const std::string& file, const ImportOptions& options);

/// Writes lines `x,y,z,r,group` in m with 17 significant digits.
void export_csv(const Specimen& specimen, const std::string& file);

} // namespace proveta
