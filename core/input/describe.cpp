#include "core/input/describe.hpp"

#include <fmt/format.h>

#include "core/input/units.hpp"

namespace proveta::input {

void Describer::add(const std::string& key, const std::string& meaning, Unit unit, const std::string& fallback,
                    const std::string& allowed) {
    out_.push_back({prefix_ + key, meaning, si_unit(unit), fallback, allowed, false});
}

void Describer::number(const char* key, double& value, Unit unit, const Bounds& bounds, const char* meaning) {
    add(key, meaning, unit, format_quantity(value, unit), bounds.text());
}

void Describer::number_or_word(const char* key, NumberOrWord& value, const std::vector<Choice>& words, Unit unit, const Bounds& bounds,
                               const char* meaning) {
    std::string allowed = bounds.text();
    for (const auto& w : words) {
        allowed += fmt::format(", or \"{}\" ({})", w.name, w.meaning);
    }
    add(key, meaning, unit, value.word.empty() ? format_quantity(value.number, unit) : '"' + value.word + '"', allowed);
}

void Describer::integer(const char* key, std::int64_t& value, std::int64_t low, std::int64_t high, const char* meaning) {
    add(key, meaning, Unit::none, fmt::format("{}", value), fmt::format("whole number from {} to {}", low, high));
}

void Describer::text(const char* key, std::string& value, const char* meaning) { add(key, meaning, Unit::none, '"' + value + '"', "text"); }

void Describer::choice(const char* key, std::string& value, const std::vector<Choice>& choices, const char* meaning) {
    std::string allowed;
    for (const auto& c : choices) {
        allowed += fmt::format("{}\"{}\"{}", allowed.empty() ? "" : ", ", c.name, c.meaning.empty() ? "" : " (" + c.meaning + ")");
    }
    add(key, meaning, Unit::none, '"' + value + '"', allowed);
}

void Describer::numbers(const char* key, std::vector<double>& values, std::size_t count, Unit unit, const Bounds& bounds,
                        const char* meaning) {
    std::string fallback;
    for (const double v : values) {
        fallback += (fallback.empty() ? "" : ", ") + format_quantity(v, unit);
    }
    add(key, meaning, unit, fallback, fmt::format("list of {}numbers, each {}", count > 0 ? fmt::format("{} ", count) : "", bounds.text()));
}

bool Describer::begin_section(const char* key, const char* meaning) {
    out_.push_back({prefix_ + key, meaning, "", "", "", true});
    prefix_ += std::string(key) + ".";
    return true;
}

void Describer::end_section() {
    prefix_.pop_back();
    const auto dot = prefix_.rfind('.');
    prefix_ = dot == std::string::npos ? "" : prefix_.substr(0, dot + 1);
}

std::optional<std::size_t> Describer::begin_list(const char* key, std::size_t, const char* meaning) {
    begin_section(key, meaning);
    return 1;
}

void Describer::begin_item(std::size_t) { prefix_ += "N."; }

std::string as_text(const std::vector<ParameterInfo>& parameters) {
    std::string out;
    for (const auto& p : parameters) {
        if (p.section) {
            out += fmt::format("{}\n    {}\n", p.path, p.meaning);
        } else {
            out += fmt::format("{}{}\n    {}\n    default {}; {}\n", p.path, p.unit.empty() ? "" : " [" + p.unit + "]", p.meaning,
                               p.fallback, p.allowed);
        }
    }
    return out;
}

std::string as_markdown(const std::vector<ParameterInfo>& parameters) {
    std::string out = "| key | meaning | unit | default | allowed |\n|---|---|---|---|---|\n";
    for (const auto& p : parameters) {
        out += fmt::format("| `{}` | {} | {} | {} | {} |\n", p.path, p.meaning, p.unit, p.fallback, p.allowed);
    }
    return out;
}

} // namespace proveta::input
