// The cards in materials/cards, built into the program.
#pragma once

#include <map>
#include <string>

namespace proveta {

/// JSON text of each card by its name. Generated from materials/cards/*.json at build time.
const std::map<std::string, std::string>& builtin_cards();

} // namespace proveta
