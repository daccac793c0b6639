// Tables of numbers in any dialect, measured curves and curves that are targets.
#include <limits>

#include "core/input/column_heading.hpp"
#include "core/input/text_table.hpp"
#include "lab/calibrate/target_curve.hpp"
#include "lab/trials/csv.hpp"
#include "materials/measured.hpp"
#include "tests/fuzz/scratch.hpp"
#include "tests/fuzz/targets.hpp"

namespace proveta::fuzz {

void read_csv_file(std::string_view bytes) {
    const std::string file = scratch_file("table.csv", bytes);
    may_refuse([&] { (void)read_csv(file); });
    may_refuse([&] {
        if (is_measured_curve(file)) {
            (void)load_measured_curve(file);
        }
    });
    may_refuse([&] {
        const input::TextTable table(file);
        (void)table.description();
        (void)input::match_column(table, {"axial strain", {"strain", "axial strain"}, input::Unit::none, 1.0});
        for (std::size_t c = 0; c < table.columns().size(); ++c) {
            may_refuse([&] { (void)table.numbers(table.find(table.columns()[c].heading)); });
        }
    });
    may_refuse([&] {
        TargetInput target;
        target.test = "ucs";
        target.curve = file;
        target.y = "total_stress";
        (void)load_target_curve(target, "ucs", std::numeric_limits<double>::infinity());
    });
}

} // namespace proveta::fuzz
