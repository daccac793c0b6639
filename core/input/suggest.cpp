#include "core/input/suggest.hpp"

#include <algorithm>

#include "core/input/words.hpp"

namespace proveta::input {

namespace {

// Edits (insert, delete, replace, swap of neighbours) between two words.
std::size_t edits(const std::string& a, const std::string& b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
            }
        }
    }
    return d[a.size()][b.size()];
}

} // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& candidates) {
    if (word.size() > 100) {
        return "";
    }
    std::string best;
    std::size_t fewest = std::max<std::size_t>(1, (word.size() + 2) / 3) + 1;
    for (const auto& c : candidates) {
        const std::size_t n = edits(lower_case(word), lower_case(c));
        if (n < fewest) {
            fewest = n;
            best = c;
        }
    }
    return best;
}

} // namespace proveta::input
