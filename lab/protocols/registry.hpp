// The tests that the laboratory knows.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lab/protocols/protocol.hpp"

namespace proveta {

/// A protocol with its default loading, or null.
std::unique_ptr<Protocol> make_protocol(const std::string& name);

std::vector<std::string> test_names();
std::vector<input::Choice> test_choices();

} // namespace proveta
