// Fields for ParaView: points, lines and polygons with named arrays, and a series over physical time.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/vector_field.hpp"

namespace proveta::report {

/// A named array over points or cells: `components` numbers each.
struct FieldArray {
    std::string name;
    int components = 1;
    std::vector<double> values;
};

/// Values of an array: x, y, z of one point after the other; numbers of any kind.
std::vector<double> interleaved(const VectorField& field);
template <class T> std::vector<double> as_numbers(const std::vector<T>& values) { return {values.begin(), values.end()}; }

/// Points (m), the cells on them (two points: a line, more: a polygon; none: one vertex a point), and arrays on both.
struct Geometry {
    VectorField points;
    std::vector<std::vector<std::int64_t>> cells;
    std::vector<FieldArray> point_arrays;
    std::vector<FieldArray> cell_arrays;
};

/// Writes one compressed .vtp file, whole or not at all. Throws std::runtime_error.
void write_vtp(const std::string& file, const Geometry& geometry);

/// A file of a series: time in s, part name, file name relative to the .pvd.
struct SeriesEntry {
    double time;
    std::string part;
    std::string file;
};

/// Text of a ParaView data collection.
std::string to_pvd(const std::vector<SeriesEntry>& entries);

} // namespace proveta::report
