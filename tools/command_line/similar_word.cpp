#include "similar_word.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

namespace espalier::tools {

namespace {

/// The optimal string alignment distance (Damerau 1964), over three rows of its table.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = std::min(row[j], before_last[j - 2] + 1);
            }
        }
        std::swap(before_last, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

}  // namespace

std::string similar_word(std::string_view typed, std::span<const std::string> words) {
    std::string lower(typed);
    for (char& letter : lower) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    std::string nearest;
    std::size_t least = typed.size() / 3 + 1;
    for (const std::string& word : words) {
        const std::size_t found = distance(lower, word);
        if (found >= least) continue;
        least = found;
        nearest = word;
    }
    return nearest;
}

}  // namespace espalier::tools
