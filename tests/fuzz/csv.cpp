// Tables of numbers and measured curves.
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
}

} // namespace proveta::fuzz
