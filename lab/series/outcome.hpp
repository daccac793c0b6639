// What a calculation on measured data returns when the data may not allow it.
#pragma once

#include <optional>
#include <string>

namespace proveta {

/// A value, or the reason why there is none, as half a sentence for the reader of the report.
template <class T> struct Outcome {
    std::optional<T> value;
    std::string reason;

    explicit operator bool() const { return value.has_value(); }
    const T& operator*() const { return *value; }
    const T* operator->() const { return &*value; }
};

} // namespace proveta
