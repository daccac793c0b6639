// "Did you mean ...?"
#pragma once

#include <string>
#include <vector>

namespace proveta::input {

/// The candidate nearest to a misspelt word (Damerau-Levenshtein, at most a third of its letters wrong, case ignored), or "".
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

} // namespace proveta::input
