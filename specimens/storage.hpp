// Specimens on disk.
#pragma once

#include <string>

#include "specimens/specimen.hpp"

namespace proveta {

/// Stores a specimen with its recipe and statistics as HDF5; the file appears whole or not at all. Throws FileError.
void save_specimen(const Specimen& specimen, const std::string& file);

/// Throws std::runtime_error naming what is wrong: missing, not HDF5, not a specimen, impossible numbers.
Specimen load_specimen(const std::string& file);

} // namespace proveta
