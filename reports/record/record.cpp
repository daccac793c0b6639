#include "reports/record/record.hpp"

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

} // namespace proveta::report
