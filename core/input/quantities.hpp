// The declared numbers of a struct with their dimensions, to be looked at together.
#pragma once

#include <string>
#include <vector>

#include "core/input/declare.hpp"

namespace proveta::input {

/// A number as it is now.
struct DeclaredQuantity {
    std::string path;   ///< JSON pointer
    std::string key;    ///< its last part; that of its list for a number of a list
    double value = 0.0; ///< SI
    Unit unit = Unit::none;
};

/// Collects the numbers of a struct in the order of declaration; words are left out.
class QuantityLister : public Visitor {
  public:
    [[nodiscard]] std::vector<DeclaredQuantity> take() { return std::move(out_); }

    void number(const char* key, double& value, Unit unit, const Bounds&, const char*) override { add(key, "", value, unit); }
    void number_or_word(const char* key, NumberOrWord& value, const std::vector<Choice>&, Unit unit, const Bounds&, const char*) override {
        if (value.word.empty()) {
            add(key, "", value.number, unit);
        }
    }
    void integer(const char*, std::int64_t&, std::int64_t, std::int64_t, const char*) override {}
    void text(const char*, std::string&, const char*) override {}
    void choice(const char*, std::string&, const std::vector<Choice>&, const char*) override {}
    void numbers(const char* key, std::vector<double>& values, std::size_t, Unit unit, const Bounds&, const char*) override {
        for (std::size_t k = 0; k < values.size(); ++k) {
            add(key, "/" + std::to_string(k), values[k], unit);
        }
    }
    void refused(const char*, const char*) override {}

  protected:
    bool begin_section(const char* key, const char*) override {
        paths_.push_back(paths_.back() + "/" + key);
        return true;
    }
    void end_section() override { paths_.pop_back(); }
    std::optional<std::size_t> begin_list(const char* key, std::size_t size, const char* meaning) override {
        begin_section(key, meaning);
        return size;
    }
    void begin_item(std::size_t k) override { paths_.push_back(paths_.back() + "/" + std::to_string(k)); }
    void end_list() override { end_section(); }

  private:
    void add(const std::string& key, const std::string& item, double value, Unit unit) {
        out_.push_back({paths_.back() + "/" + key + item, key, value, unit});
    }

    std::vector<std::string> paths_{""};
    std::vector<DeclaredQuantity> out_;
};

/// The numbers of a struct.
template <class T> std::vector<DeclaredQuantity> quantities(const T& value) {
    QuantityLister lister;
    // Visitors take what they visit by reference; listing changes nothing.
    declare(static_cast<Visitor&>(lister), const_cast<T&>(value));
    return lister.take();
}

} // namespace proveta::input
