// What is fuzzed: all that reads files. Each target is one function from the bytes of a file to the readers of such files.
#pragma once

#include <array>
#include <string_view>

namespace proveta::fuzz {

/// Each gives the bytes to the readers they are for and takes what those document as their way to refuse a file: InputError or another
/// std::runtime_error that says why. Whatever else happens is a defect of the reader. Nothing is left behind.
void read_deck_file(std::string_view bytes);    ///< decks, series, sweeps, calibrations, scenes: by the keys that are there
void read_card_file(std::string_view bytes);    ///< material cards
void read_csv_file(std::string_view bytes);     ///< tables of numbers in any dialect, measured curves, targets' curves
void read_mesh_file(std::string_view bytes);    ///< meshes of deformable bodies and of spheres: by how the file begins
void read_surface_file(std::string_view bytes); ///< surfaces: by how the file begins
void read_hdf5_file(std::string_view bytes);    ///< specimens and checkpoints

struct Target {
    std::string_view name; ///< of its folders of files, its dictionary and its fuzzer
    void (*read)(std::string_view bytes);
};

constexpr std::array<Target, 6> targets{{{"deck", read_deck_file},
                                         {"card", read_card_file},
                                         {"csv", read_csv_file},
                                         {"mesh", read_mesh_file},
                                         {"surface", read_surface_file},
                                         {"hdf5", read_hdf5_file}}};

} // namespace proveta::fuzz
