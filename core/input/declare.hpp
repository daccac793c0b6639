// Parameters declared once. A struct says what may be set in it by a function
//
//     void declare(Visitor& v, Loading& loading) {
//         v.number("rate", loading.rate, Unit::velocity, above(0), "closing speed of the platens");
//     }
//
// and visitors do the rest: one reads JSON and collects every problem, one writes the resolved values, one makes the JSON schema, one the
// reference documentation. The default of a parameter is the member's value in a freshly made struct.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace proveta::input {

/// Physical dimension of a parameter; decides which unit texts a string may carry. Values inside are SI.
enum class Unit {
    none,
    length,
    area,
    pressure,
    density,
    velocity,
    time,
    energy_per_area,
    acceleration,
    angle,
    angular_velocity,
    force,
    rate, ///< events a second
    any   ///< a number whose dimension depends on another key; every unit text is taken
};

/// Allowed range of a number.
struct Bounds {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_open = false; ///< low itself is not allowed
    bool high_open = false;

    [[nodiscard]] bool contains(double x) const { return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high); }
    [[nodiscard]] std::string text() const;
};

inline Bounds any_number() { return {}; }
inline Bounds above(double low) { return {low, std::numeric_limits<double>::infinity(), true, false}; }
inline Bounds at_least(double low) { return {low, std::numeric_limits<double>::infinity(), false, false}; }
inline Bounds between(double low, double high) { return {low, high, false, false}; }
inline Bounds between_open(double low, double high) { return {low, high, true, true}; }

/// One of a fixed set of words.
struct Choice {
    std::string name;
    std::string meaning;
};

/// A number, or one of a few words that stand for a rule ("auto", "glued").
struct NumberOrWord {
    double number = 0.0;
    std::string word; ///< empty: the number counts
};

/// Walks over the declared parameters of a struct. Keys are unique within a section.
class Visitor {
  public:
    virtual ~Visitor() = default;

    virtual void number(const char* key, double& value, Unit unit, const Bounds& bounds, const char* meaning) = 0;
    virtual void number_or_word(const char* key, NumberOrWord& value, const std::vector<Choice>& words, Unit unit, const Bounds& bounds,
                                const char* meaning) = 0;
    virtual void integer(const char* key, std::int64_t& value, std::int64_t low, std::int64_t high, const char* meaning) = 0;
    virtual void text(const char* key, std::string& value, const char* meaning) = 0;
    virtual void choice(const char* key, std::string& value, const std::vector<Choice>& choices, const char* meaning) = 0;
    /// A list of `count` numbers; 0: of one or more.
    virtual void numbers(const char* key, std::vector<double>& values, std::size_t count, Unit unit, const Bounds& bounds,
                         const char* meaning) = 0;
    /// A key that users may expect here and that is refused, with the reason.
    virtual void refused(const char* key, const char* reason) = 0;

    /// True for visitors that want to know every parameter there may be, not only those that go with the values of others.
    [[nodiscard]] bool wants_all() const { return reads_only_shape(); }

    /// A nested object.
    template <class T> void section(const char* key, T& value, const char* meaning) {
        if (begin_section(key, meaning)) {
            declare(*this, value);
            end_section();
        }
    }

    /// A list of objects. New items start as T{}.
    template <class T> void list(const char* key, std::vector<T>& items, const char* meaning) {
        const std::optional<std::size_t> n = begin_list(key, items.size(), meaning);
        if (!n) {
            return;
        }
        std::vector<T> prototype(1);
        auto& used = reads_only_shape() ? prototype : items;
        used.resize(*n);
        for (std::size_t k = 0; k < *n; ++k) {
            begin_item(k);
            declare(*this, used[k]);
            end_section();
        }
        end_list();
    }

  protected:
    virtual bool begin_section(const char* key, const char* meaning) = 0;
    virtual void end_section() = 0;
    /// Number of items to visit, or nothing to skip the list.
    virtual std::optional<std::size_t> begin_list(const char* key, std::size_t size, const char* meaning) = 0;
    virtual void begin_item(std::size_t k) = 0;
    virtual void end_list() = 0;
    /// True for visitors that look at one made-up item instead of the real ones (schema, documentation).
    [[nodiscard]] virtual bool reads_only_shape() const { return false; }
};

} // namespace proveta::input
