// Headings of tables: what they name, in which unit.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/input/declare.hpp"
#include "core/input/text_table.hpp"

namespace proveta::input {

/// Name and unit of a heading: "Stress [MPa]", "strain (%)", "stress / MPa", "stress, MPa", "force_kN", "eps_a_microstrain". What stands at
/// the end and is no unit belongs to the name.
TextColumn column_of_heading(const std::string& heading);

/// The unit in a cell of a row of units: "MPa", "[MPa]", "(-)"; empty when it is none.
std::string unit_in_brackets(const std::string& cell);

/// True when all cells that are not empty are units.
bool is_row_of_units(const std::vector<std::string_view>& cells);

/// Factor that makes SI of a unit as tables write it, beside the texts of decks "N/mm²", "‰", "microstrain", "mm/m"; none when it is no
/// unit of that dimension.
std::optional<double> unit_factor(const std::string& unit, Unit dimension);

/// Lower case with words apart by single blanks: "Axial_Strain" as "axial strain".
std::string plain_name(const std::string& name);

/// What a reader of tables looks for.
struct WantedColumn {
    std::string name;               ///< as people call it, "axial strain"
    std::vector<std::string> names; ///< plain names that mean it
    Unit unit = Unit::none;
    double factor = 1.0; ///< makes SI of the file's numbers where it names no unit
};

/// A column that was found.
struct MatchedColumn {
    std::size_t index = 0;
    double factor = 1.0;
    std::string said; ///< "read 'Axial strain (%)' as axial strain, in %"
};

/// Finds a column by name and unit; none when the table has no heading that means it. Throws std::runtime_error when two have, or when the
/// unit is of another dimension.
std::optional<MatchedColumn> match_column(const TextTable& table, const WantedColumn& wanted);

} // namespace proveta::input
