#include "reports/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/input/json.hpp"
#include "reports/svg.hpp"

namespace proveta::report {

namespace {

constexpr std::size_t most_points = 12000; // of a plot, so that pages stay light
constexpr PlotLook look{480, 320, 13, false};

// A text as JSON that can stand within a script element: nothing in it ends the element or begins a comment.
std::string quoted(const std::string& text) {
    const std::string json = input::Json(text).dump(-1, ' ', false, input::Json::error_handler_t::replace);
    std::string out;
    for (const char c : json) {
        switch (c) {
        case '<': out += "\\u003c"; break;
        case '>': out += "\\u003e"; break;
        case '&': out += "\\u0026"; break;
        default: out += c;
        }
    }
    return out;
}

std::string numbers(const std::vector<double>& values) {
    std::string out;
    for (const double v : values) {
        out += fmt::format("{}{:.6g}", out.empty() ? "" : ",", v);
    }
    return "[" + out + "]";
}

// Every so many-th point, and always the ends and the extremes; none that is not a number.
Curve thinned(const Curve& c, std::size_t every) {
    const auto [low, high] = std::minmax_element(c.y.begin(), c.y.end());
    Curve out = c;
    out.x.clear();
    out.y.clear();
    for (std::size_t k = 0; k < c.x.size(); ++k) {
        const auto at = c.y.begin() + static_cast<std::ptrdiff_t>(k);
        const bool kept = k % every == 0 || k + 1 == c.x.size() || at == low || at == high;
        if (kept && std::isfinite(c.x[k]) && std::isfinite(c.y[k])) {
            out.x.push_back(c.x[k]);
            out.y.push_back(c.y[k]);
        }
    }
    return out;
}

Plot light_enough(Plot plot) {
    std::size_t points = 0;
    for (const auto& c : plot.curves) {
        points += c.x.size();
    }
    for (auto& c : plot.curves) {
        c = thinned(c, points / most_points + 1);
    }
    return plot;
}

const char* name_of(CurveStyle style) {
    switch (style) {
    case CurveStyle::dashed: return "dashed";
    case CurveStyle::points: return "points";
    case CurveStyle::bars: return "bars";
    default: return "solid";
    }
}

std::string data_of(const Plot& plot, const std::vector<int>& markers) {
    const PlotRange range = range_of(plot);
    std::string out = fmt::format("{{\"x\":{},\"y\":{},\"range\":{},\"equal\":{},\"rows\":[", quoted(plot.x_title), quoted(plot.y_title),
                                  numbers({range.x0, range.x1, range.y0, range.y1}), plot.equal_scale);
    for (std::size_t k = 0; k < plot.rows.size(); ++k) {
        out += (k == 0 ? "" : ",") + quoted(plot.rows[k]);
    }
    out += "],\"curves\":[";
    for (std::size_t k = 0; k < plot.curves.size(); ++k) {
        const Curve& c = plot.curves[k];
        out += fmt::format("{}{{\"name\":{},\"colour\":{},\"style\":\"{}\",\"width\":{:.3g},\"marker\":{},\"x\":{},\"y\":{}}}",
                           k == 0 ? "" : ",", quoted(c.name), quoted(c.colour), name_of(c.style), c.width, markers[k], numbers(c.x),
                           numbers(c.y));
    }
    out += "],\"marks\":[";
    for (std::size_t k = 0; k < plot.marks.size(); ++k) {
        out += (k == 0 ? "" : ",") + numbers({plot.marks[k].first, plot.marks[k].second});
    }
    return out + "]}";
}

std::string key_entry(const std::string& attributes, const std::string& sign, const std::string& name) {
    return fmt::format("<li{}><svg class=\"sign\" viewBox=\"0 0 24 14\" aria-hidden=\"true\">{}</svg><span>{}</span></li>", attributes,
                       sign, escape(name));
}

std::string key_of(const Plot& plot, const std::vector<int>& markers) {
    std::string out;
    int bars = 0;
    std::size_t named = 0;
    for (std::size_t k = 0; k < plot.curves.size(); ++k) {
        const Curve& c = plot.curves[k];
        const int marker = c.style == CurveStyle::bars ? bars++ : markers[k];
        if (!c.name.empty()) {
            out += key_entry(fmt::format(" data-curve=\"{}\"", k), key_sign(c, marker, 1, 7), c.name);
            ++named;
        }
    }
    return plot.curves.size() > 1 && named > 0 ? "<ul class=\"key\">" + out + "</ul>" : "";
}

} // namespace

std::string figure(const Plot& full) {
    const Plot plot = light_enough(full);
    const auto markers = markers_of(plot);
    return fmt::format("<figure class=\"plot\"><figcaption>{}</figcaption><div class=\"drawing\">{}</div>{}"
                       "<script type=\"application/json\">{}</script></figure>\n",
                       escape(plot.title), to_svg(plot, look), key_of(plot, markers), data_of(plot, markers));
}

std::string figure(const Rose& rose) {
    std::string key;
    for (std::size_t k = 0; k < rose.parts.size(); ++k) {
        const Curve sign{rose.parts[k].name, {}, {}, rose.parts[k].colour, CurveStyle::bars};
        key += key_entry("", key_sign(sign, k > 0 ? 1 : 0, 1, 7), sign.name);
    }
    if (!rose.even_name.empty()) {
        key += key_entry("", key_sign({"", {}, {}, "#111", CurveStyle::dashed}, -1, 1, 7), rose.even_name);
    }
    return fmt::format("<figure class=\"rose\">{}<ul class=\"key\">{}</ul><figcaption><b>{}</b> {}</figcaption></figure>\n", to_svg(rose),
                       key, escape(rose.title), escape(rose.about));
}

std::string figure(const Picture& p) {
    return fmt::format("<figure class=\"picture\">{}<figcaption><b>{}.</b> {}</figcaption></figure>\n", to_svg(p), escape(p.title),
                       escape(p.caption));
}

std::string figure(const Portrait& p) {
    return fmt::format(
        "<figure class=\"picture\"><img alt=\"{}\" src=\"data:image/png;base64,{}\"><figcaption><b>{}.</b> {}</figcaption></figure>\n",
        escape(p.alt), base64(p.png), escape(p.title), escape(p.caption));
}

std::string base64(std::string_view bytes) {
    constexpr const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
        std::uint32_t bits = 0;
        const std::size_t n = std::min<std::size_t>(3, bytes.size() - k);
        for (std::size_t b = 0; b < 3; ++b) {
            bits = (bits << 8) | (b < n ? static_cast<unsigned char>(bytes[k + b]) : 0U);
        }
        for (std::size_t c = 0; c < 4; ++c) {
            out += c <= n ? letters[(bits >> (18 - 6 * c)) & 63U] : '=';
        }
    }
    return out;
}

} // namespace proveta::report
