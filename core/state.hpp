// Values that later steps depend on, gone through by name.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace proveta {

/// Stores or restores. Whoever has a state names each of its values once, and the same words do both.
class StateVisitor {
  public:
    virtual ~StateVisitor() = default;
    virtual void operator()(const std::string& name, double& value) = 0;
    virtual void operator()(const std::string& name, std::int64_t& value) = 0;
    virtual void operator()(const std::string& name, std::string& value) = 0;
    virtual void operator()(const std::string& name, std::vector<double>& values) = 0;
    virtual void operator()(const std::string& name, std::vector<std::int32_t>& values) = 0;
    virtual void operator()(const std::string& name, std::vector<std::uint8_t>& values) = 0;
};

} // namespace proveta
