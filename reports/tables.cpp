#include "reports/tables.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cstdlib>
#include <string_view>

#include "reports/svg.hpp"

namespace proveta::report {

namespace {

// True for a text that is a number, or one in per cent, and nothing else.
bool numeric(const std::string& text) {
    char* end = nullptr;
    std::strtod(text.c_str(), &end);
    const std::string_view rest(end);
    return !text.empty() && end != text.c_str() && (rest.empty() || rest == " %");
}

// True for a column of numbers, some of which may be missing.
bool column_of_numbers(const TextTable& t, std::size_t column) {
    bool any = false;
    for (std::size_t k = 1; k < t.rows.size(); ++k) {
        const std::string cell = column < t.rows[k].size() ? t.rows[k][column] : "";
        any = any || numeric(cell);
        if (!numeric(cell) && !cell.empty() && cell != "–") {
            return false;
        }
    }
    return any;
}

// A path as a relative address: what has a meaning of its own there is no more than a part of a name.
std::string relative_address(const std::string& path) {
    std::string out;
    for (const char c : path) {
        const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || std::string_view("/-._~").find(c) != std::string_view::npos;
        out += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return out;
}

std::string framed(const std::string& name, const std::string& kind, const std::string& rows) {
    return fmt::format("<div class=\"scroll\" role=\"region\" aria-label=\"{0}\"><table "
                       "class=\"{1}\"><caption><span>{0}</span></caption>\n{2}</table></div>\n",
                       escape(name), kind, rows);
}

} // namespace

std::string table(const TextTable& t) {
    std::string out;
    std::vector<const char*> kind; // of each column
    for (std::size_t c = 0; !t.rows.empty() && c < t.rows.front().size(); ++c) {
        kind.push_back(c > 0 && column_of_numbers(t, c) ? " class=\"num\"" : "");
    }
    for (std::size_t k = 0; k < t.rows.size(); ++k) {
        out += k == 0 ? "<thead><tr>" : "<tr>";
        for (std::size_t c = 0; c < t.rows[k].size(); ++c) {
            const std::string& cell = t.rows[k][c];
            const std::string link = c == 0 && k > 0 && k <= t.links.size() ? t.links[k - 1] : "";
            const std::string shown =
                link.empty() ? escape(cell) : fmt::format("<a href=\"{}\">{}</a>", relative_address(link), escape(cell));
            if (k == 0) {
                out += cell.empty() ? "<td></td>" : fmt::format("<th scope=\"col\"{}>{}</th>", kind[c], shown);
            } else if (c == 0) {
                out += fmt::format("<th scope=\"row\">{}</th>", shown);
            } else {
                const bool number = numeric(cell); // also where others of its column are none
                out += fmt::format("<td{}>{}</td>", number ? " class=\"num\"" : c < kind.size() ? kind[c] : "", shown);
            }
        }
        out += k == 0 ? "</tr></thead><tbody>\n" : "</tr>\n";
    }
    return framed(t.title, t.rows.empty() || t.rows.front().size() > 4 ? "wide" : "plain", out + "</tbody>");
}

std::string table(const std::vector<Scalar>& results) {
    std::string out = "<thead><tr><th scope=\"col\">Result</th><th scope=\"col\" class=\"num\">Value</th><th scope=\"col\">Unit</th>"
                      "<th scope=\"col\">How it is found</th></tr></thead><tbody>\n";
    for (const auto& result : results) {
        const Scalar r = readable(result);
        const std::string value =
            r.value ? fmt::format("<td class=\"num\">{}</td>", three_digits(*r.value)) : "<td class=\"none\">not determined</td>";
        out += fmt::format("<tr><th scope=\"row\">{}</th>{}<td class=\"unit\">{}</td><td class=\"how\">{}</td></tr>\n", escape(r.title),
                           value, r.value ? escape(r.unit) : "", escape(r.formula));
    }
    return framed("All results", "results", out + "</tbody>");
}

} // namespace proveta::report
