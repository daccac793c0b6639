#include "reports/html.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/figure.hpp"
#include "reports/page/page.hpp"
#include "reports/svg.hpp"
#include "reports/tables.hpp"

namespace proveta::report {

namespace {

// From hexadecimal digits to base 64, which a content security policy wants.
std::string base64_of_hex(std::string_view hex) {
    const auto digit = [&](std::size_t k) { return hex[k] <= '9' ? hex[k] - '0' : hex[k] - 'a' + 10; };
    std::string bytes;
    for (std::size_t k = 0; k + 1 < hex.size(); k += 2) {
        bytes += static_cast<char>(16 * digit(k) + digit(k + 1));
    }
    return base64(bytes);
}

// Headings of the page, of which the contents are made.
class Parts {
  public:
    /// Begins a part and returns its heading.
    std::string begin(const std::string& title) {
        titles_.push_back(title);
        return fmt::format("{0}<section aria-labelledby=\"part{1}\">\n<h2 id=\"part{1}\">{2}</h2>\n",
                           titles_.size() > 1 ? "</section>\n" : "", titles_.size(), escape(title));
    }
    [[nodiscard]] std::string end() const { return titles_.empty() ? "" : "</section>\n"; }

    [[nodiscard]] std::string contents() const {
        std::string out = "<nav aria-label=\"Contents\"><ul>";
        for (std::size_t k = 0; k < titles_.size(); ++k) {
            out += fmt::format("<li><a href=\"#part{}\">{}</a></li>", k + 1, escape(titles_[k]));
        }
        return out + "</ul></nav>\n";
    }

  private:
    std::vector<std::string> titles_;
};

template <class Figures> std::string figures(const Figures& list, const char* kind) {
    std::string out;
    for (const auto& one : list) {
        out += figure(one);
    }
    return list.empty() ? "" : fmt::format("<div class=\"figures {}\">\n{}</div>\n", kind, out);
}

std::string head(const Record& r) {
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta http-equiv=\"Content-Security-Policy\" "
        "content=\"default-src "
        "'none'; style-src 'sha256-{}'; script-src 'sha256-{}'; img-src data:; base-uri 'none'; form-action 'none'\">\n"
        "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>{}</title>\n<style>{}</style></head>\n<body>\n"
        "<a class=\"skip\" href=\"#main\">Skip to the results</a>\n",
        base64_of_hex(page_style_sha256), base64_of_hex(page_script_sha256), escape(r.title), page_style);
}

// What is wanted first: the answer, and whether to trust it.
std::string summary(const Record& r) {
    std::string out =
        fmt::format("<header>\n<h1>{}</h1>\n<p class=\"sub\">{}</p>\n<p class=\"ending\"><span class=\"status {}\">{}</span> {}</p>\n",
                    escape(r.title), escape(r.subtitle), r.status == "complete" ? "good" : "bad", escape(r.status), escape(r.stopped_by));
    if (!r.key_figures.empty()) {
        out += "<dl class=\"figures-first\">\n";
        for (const auto& f : r.key_figures) {
            out += fmt::format("<div><dt>{}</dt><dd><b>{}</b>{}</dd>{}</div>\n", escape(f.label), escape(f.value),
                               f.unit.empty() ? "" : " <span>" + escape(f.unit) + "</span>",
                               f.note.empty() ? "" : "<dd class=\"note\">" + escape(f.note) + "</dd>");
        }
        out += "</dl>\n";
    }
    if (!r.badges.empty()) {
        out += "<ul class=\"verdicts\">";
        for (const auto& b : r.badges) {
            out += fmt::format("<li class=\"{}\"><span aria-hidden=\"true\">{}</span> <b>{}</b> {}</li>", b.good ? "good" : "bad",
                               b.good ? "\u2713" : "!", escape(b.name), escape(b.verdict));
        }
        out += "</ul>\n";
    }
    out += "</header>\n";
    if (!r.warnings.empty()) {
        out += "<div class=\"warn\" role=\"note\"><p><b>To be read with the results</b></p><ul>";
        for (const auto& w : r.warnings) {
            out += fmt::format("<li>{}</li>\n", escape(w));
        }
        out += "</ul></div>\n";
    }
    return out;
}

std::string checks(const std::vector<Badge>& badges) {
    std::string out;
    for (const auto& b : badges) {
        out += fmt::format("<div class=\"check {}\"><p><b>{}:</b> {}</p><dl>", b.good ? "good" : "bad", escape(b.name), escape(b.verdict));
        for (const auto& [name, found] : b.figures) {
            out += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", escape(name), escape(found));
        }
        out += "</dl></div>\n";
    }
    return out;
}

std::string of_section(const Section& s) {
    std::string out = s.about.empty() ? "" : fmt::format("<p class=\"about\">{}</p>\n", escape(s.about));
    out += figures(s.plots, "plots") + figures(s.roses, "roses");
    for (const auto& t : s.tables) {
        out += table(t);
    }
    return out;
}

} // namespace

std::string to_html(const Record& r) {
    Parts parts;
    std::string body;
    if (!r.overview.empty()) {
        body += parts.begin("Overview");
        for (const auto& t : r.overview) {
            body += table(t);
        }
    }
    if (!r.plots.empty()) {
        body += parts.begin("Curves");
        body +=
            "<p class=\"hint\" hidden>Point at a plot for its values. Drag to zoom, with Shift to move; once a plot is clicked, the wheel "
            "zooms and the arrow keys move the cursor. Names below a plot switch its curves off and on.</p>\n";
        body += figures(r.plots, "plots first-wide");
    }
    if (!r.results.empty()) {
        body += parts.begin("Results") + table(r.results);
    }
    if (!r.badges.empty()) {
        body += parts.begin("Checks") + checks(r.badges);
    }
    if (!r.portraits.empty()) {
        body += parts.begin("Pictures") + figures(r.portraits, "pictures");
    }
    if (!r.pictures.empty()) {
        body += parts.begin("Slices") + figures(r.pictures, "pictures");
    }
    for (const auto& s : r.sections) {
        body += parts.begin(s.title) + of_section(s);
    }
    if (!r.tables.empty()) {
        body += parts.begin("Details");
        for (const auto& t : r.tables) {
            body += table(t);
        }
    }
    if (!r.citation.empty()) {
        body += parts.begin("How to cite") + fmt::format("<p class=\"cite\">{}</p>\n", escape(r.citation));
    }
    return fmt::format("{}<main id=\"main\">\n{}{}{}{}</main>\n<script>{}</script>\n</body></html>\n", head(r), summary(r),
                       parts.contents(), body, parts.end(), page_script);
}

} // namespace proveta::report
