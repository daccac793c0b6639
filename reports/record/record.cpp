#include "reports/record/record.hpp"

#include <cmath>
#include <stdexcept>

namespace proveta::report {

std::size_t Table::column(const std::string& name) const {
    for (std::size_t k = 0; k < columns.size(); ++k) {
        if (columns[k].name == name) {
            return k;
        }
    }
    throw std::out_of_range("no column " + name);
}

std::vector<double> Table::values(const std::string& name) const {
    const std::size_t k = column(name);
    std::vector<double> out;
    out.reserve(rows.size());
    for (const auto& row : rows) {
        out.push_back(row[k]);
    }
    return out;
}

Scalar readable(Scalar s) {
    if (s.unit == "Pa" && s.value) {
        const bool giga = std::fabs(*s.value) >= 1e9;
        s.value = *s.value / (giga ? 1e9 : 1e6);
        s.unit = giga ? "GPa" : "MPa";
    } else if (s.value && s.name.find("strain") != std::string::npos) {
        s.value = *s.value * 100.0;
        s.unit = "%";
    }
    return s;
}

} // namespace proveta::report
