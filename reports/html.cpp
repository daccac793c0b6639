#include "reports/html.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "reports/svg.hpp"

namespace proveta::report {

namespace {

constexpr const char* style = R"(
body{font:15px/1.5 system-ui,sans-serif;color:#1b2530;background:#fff;max-width:1040px;margin:0 auto;padding:1.2rem}
h1{font-size:1.6rem;margin:.2rem 0}h2{font-size:1.15rem;margin:1.8rem 0 .5rem;border-bottom:2px solid #1f4e79;padding-bottom:.2rem}
.sub{color:#4a5866;margin:0}
table{border-collapse:collapse;width:100%;font-size:.92rem}
th,td{text-align:left;padding:.3rem .6rem;border-bottom:1px solid #dde3e8;vertical-align:top}
th{background:#f2f5f8}td.num{text-align:right;white-space:nowrap;font-variant-numeric:tabular-nums}
.badge{border-left:6px solid #1e7b46;background:#eef7f1;padding:.5rem .9rem;margin:.6rem 0}.badge.bad{border-color:#b03a2e;background:#fbeeec}
.badge b{display:block}.warn{border-left:6px solid #b9770e;background:#fdf4e3;padding:.4rem .9rem;margin:.4rem 0}
.row{display:flex;flex-wrap:wrap;gap:1rem}.row figure{flex:1 1 200px;max-width:320px;margin:0}
.scroll{overflow-x:auto}.scroll td:first-child,.scroll th:first-child{position:sticky;left:0;min-width:9rem}.scroll td:first-child{background:#fff}
.row figure.plot{flex:1 1 440px;max-width:none}.row figure.plot:first-child{flex-basis:100%}
figcaption{font-size:.85rem;color:#4a5866}
svg{width:100%;height:auto}code{font-size:.88rem;overflow-wrap:anywhere}
.status{display:inline-block;padding:.1rem .6rem;border-radius:1rem;background:#1e7b46;color:#fff;font-size:.85rem}.status.bad{background:#b03a2e}
@media print{body{max-width:none;padding:0}h2{break-after:avoid}figure{break-inside:avoid}}
@media(max-width:600px){body{padding:.7rem}}
)";

std::string results_table(const std::vector<Scalar>& results) {
    std::string out = "<div class=\"scroll\"><table><tr><th>Result</th><th>Value</th><th>Unit</th><th>How it is found</th></tr>\n";
    for (const auto& result : results) {
        const Scalar r = readable(result);
        const std::string value = r.value ? fmt::format("{:.5g}", *r.value) : "not determined";
        out += fmt::format("<tr><td>{}</td><td class=\"num\">{}</td><td>{}</td><td>{}</td></tr>\n", escape(r.title), value, escape(r.unit),
                           escape(r.formula));
    }
    return out + "</table></div>\n";
}

// True for a text that is a number and nothing else.
bool numeric(const std::string& text) {
    char* end = nullptr;
    std::strtod(text.c_str(), &end);
    return !text.empty() && end == text.c_str() + text.size();
}

std::string text_table(const TextTable& t) {
    std::string out = fmt::format("<h2>{}</h2>\n<div class=\"scroll\"><table>\n", escape(t.title));
    for (std::size_t k = 0; k < t.rows.size(); ++k) {
        out += "<tr>";
        for (std::size_t c = 0; c < t.rows[k].size(); ++c) {
            const std::string& cell = t.rows[k][c];
            const std::string link = c == 0 && k > 0 && k <= t.links.size() ? t.links[k - 1] : "";
            const std::string shown = link.empty() ? escape(cell) : fmt::format("<a href=\"{}\">{}</a>", escape(link), escape(cell));
            out += k == 0 ? fmt::format("<th>{}</th>", shown)
                          : fmt::format("<td{}>{}</td>", c > 0 && numeric(cell) ? " class=\"num\"" : "", shown);
        }
        out += "</tr>\n";
    }
    return out + "</table></div>\n";
}

} // namespace

std::string to_html(const Record& r) {
    std::string out = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>{}</title><style>{}</style></head><body>\n",
        escape(r.title), style);
    out += fmt::format("<h1>{}</h1>\n<p class=\"sub\">{}</p>\n<p><span class=\"status{}\">{}</span> {}</p>\n", escape(r.title),
                       escape(r.subtitle), r.status == "complete" ? "" : " bad", escape(r.status), escape(r.stopped_by));
    for (const auto& w : r.warnings) {
        out += fmt::format("<p class=\"warn\">{}</p>\n", escape(w));
    }
    for (const auto& t : r.overview) {
        out += text_table(t);
    }
    out += "<h2>Curves</h2>\n<div class=\"row\">\n";
    for (const auto& p : r.plots) {
        out += fmt::format("<figure class=\"plot\">{}<figcaption>{}</figcaption></figure>\n", to_svg(p), escape(p.title));
    }
    out += "</div>\n";
    if (!r.results.empty()) {
        out += "<h2>Results</h2>\n" + results_table(r.results);
    }
    for (const auto& b : r.badges) {
        out += fmt::format("<div class=\"badge{}\"><b>{}: {}</b>", b.good ? "" : " bad", escape(b.name), escape(b.verdict));
        for (const auto& [name, figure] : b.figures) {
            out += fmt::format("<span>{}: {}</span><br>", escape(name), escape(figure));
        }
        out += "</div>\n";
    }
    if (!r.pictures.empty()) {
        out += "<h2>Pictures</h2>\n<div class=\"row\">\n";
        for (const auto& p : r.pictures) {
            out +=
                fmt::format("<figure>{}<figcaption><b>{}.</b> {}</figcaption></figure>\n", to_svg(p), escape(p.title), escape(p.caption));
        }
        out += "</div>\n";
    }
    for (const auto& t : r.tables) {
        out += text_table(t);
    }
    return out + "</body></html>\n";
}

} // namespace proveta::report
