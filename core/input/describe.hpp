// Declared parameters as text: reference documentation and `proveta describe`.
#pragma once

#include <string>
#include <vector>

#include "core/input/declare.hpp"

namespace proveta::input {

/// One declared parameter, ready to print.
struct ParameterInfo {
    std::string path; ///< dotted, e.g. "loading.stop.axial_strain"
    std::string meaning;
    std::string unit;     ///< SI unit, or empty
    std::string fallback; ///< default
    std::string allowed;
    bool section = false;
};

/// Collects the parameters of a struct in the order of declaration.
class Describer : public Visitor {
  public:
    explicit Describer(std::string prefix = "") : prefix_(std::move(prefix)) {}
    [[nodiscard]] const std::vector<ParameterInfo>& parameters() const { return out_; }

    void number(const char*, double&, Unit, const Bounds&, const char*) override;
    void number_or_word(const char*, NumberOrWord&, const std::vector<Choice>&, Unit, const Bounds&, const char*) override;
    void integer(const char*, std::int64_t&, std::int64_t, std::int64_t, const char*) override;
    void text(const char*, std::string&, const char*) override;
    void choice(const char*, std::string&, const std::vector<Choice>&, const char*) override;
    void numbers(const char*, std::vector<double>&, std::size_t, Unit, const Bounds&, const char*) override;
    void refused(const char*, const char*) override {}

  protected:
    bool begin_section(const char*, const char*) override;
    void end_section() override;
    std::optional<std::size_t> begin_list(const char*, std::size_t, const char*) override;
    void begin_item(std::size_t) override;
    void end_list() override { end_section(); }
    [[nodiscard]] bool reads_only_shape() const override { return true; }

  private:
    void add(const std::string& key, const std::string& meaning, Unit unit, const std::string& fallback, const std::string& allowed);

    std::string prefix_;
    std::vector<ParameterInfo> out_;
};

/// As aligned text, one parameter a paragraph.
std::string as_text(const std::vector<ParameterInfo>& parameters);

/// As a Markdown table.
std::string as_markdown(const std::vector<ParameterInfo>& parameters);

} // namespace proveta::input
