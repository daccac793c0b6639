#include "reports/files.hpp"

#include <fmt/format.h>

#include "core/files/whole_file.hpp"

namespace proveta::report {

void write_file(const std::string& file, const std::string& text) { write_whole(file, text.data(), text.size()); }

std::string to_csv(const Table& table) {
    std::string out;
    for (const auto& note : table.notes) {
        out += "# " + note + "\n";
    }
    std::string heading;
    for (const auto& c : table.columns) {
        out += fmt::format("# {}: {}\n", c.heading(), c.meaning);
        heading += (heading.empty() ? "" : ",") + c.heading();
    }
    out += heading + "\n";
    for (const auto& row : table.rows) {
        for (std::size_t k = 0; k < row.size(); ++k) {
            out += fmt::format("{}{:.17g}", k == 0 ? "" : ",", row[k]);
        }
        out += "\n";
    }
    return out;
}

std::string to_csv(const TextTable& table) {
    const auto quoted = [](const std::string& cell) {
        if (cell.find_first_of(",\"\r\n") == std::string::npos) {
            return cell;
        }
        std::string out = "\"";
        for (const char c : cell) {
            out += c == '"' ? std::string("\"\"") : std::string(1, c);
        }
        return out + "\"";
    };
    std::string out = table.title.empty() ? "" : "# " + table.title + "\n";
    for (const auto& row : table.rows) {
        for (std::size_t k = 0; k < row.size(); ++k) {
            out += (k == 0 ? "" : ",") + quoted(row[k]);
        }
        out += "\n";
    }
    return out;
}

void write_json(const std::string& file, const input::Json& json) {
    write_file(file, json.dump(2, ' ', false, input::Json::error_handler_t::replace) + "\n");
}

} // namespace proveta::report
