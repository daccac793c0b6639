#include "lab/trials/csv.hpp"

#include "core/input/text_table.hpp"

namespace proveta {

report::Table read_csv(const std::string& file) {
    const input::TextTable text(file);
    report::Table table;
    std::vector<std::vector<double>> columns;
    for (std::size_t c = 0; c < text.columns().size(); ++c) {
        table.columns.push_back({text.has_headings() ? text.columns()[c].heading : std::to_string(c + 1), "", ""});
        columns.push_back(text.numbers(c));
    }
    table.rows.assign(text.rows(), std::vector<double>(columns.size()));
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        for (std::size_t c = 0; c < columns.size(); ++c) {
            table.rows[r][c] = columns[c][r];
        }
    }
    return table;
}

} // namespace proveta
