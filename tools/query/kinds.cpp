#include "kinds.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"

namespace espalier::tools {

std::string words_text(const QueryKind& kind) {
    std::string result;
    for (const QueryWord& word : kind.words) {
        result += text(result.empty() ? "" : ", ", word.name, word.count == 3 ? " x y z" : "");
    }
    if (kind.repeats.which == Repeats::Which::all) result += "; once or more";
    if (kind.repeats.which == Repeats::Which::last) result += "; the last any number of times";
    return result;
}

unsigned word_count(const QueryKind& kind) {
    unsigned count = 0;
    for (const QueryWord& word : kind.words) count += word.count;
    return count;
}

unsigned least_count(const QueryKind& kind) {
    return word_count(kind) - (kind.repeats.which == Repeats::Which::last ? kind.words.back().count : 0);
}

std::optional<std::vector<const QueryWord*>> words_of(const QueryKind& kind, std::size_t arguments) {
    std::vector<const QueryWord*> words;
    std::size_t taken = 0;
    const auto take = [&](const QueryWord& word) {
        words.push_back(&word);
        taken += word.count;
    };
    const bool is_last = kind.repeats.which == Repeats::Which::last;
    for (std::size_t i = 0; i + (is_last ? 1 : 0) < kind.words.size(); ++i) take(kind.words[i]);
    while (kind.repeats.which != Repeats::Which::none && taken < arguments) {
        if (is_last) take(kind.words.back());
        else std::for_each(kind.words.begin(), kind.words.end(), take);
    }
    if (taken != arguments) return std::nullopt;
    return words;
}

const QueryKinds& query_kinds() {
    static const QueryKinds kinds = [] {
        QueryKinds all;
        for (const QueryKinds& family : {ray_kinds(), overlap_kinds(), distance_kinds(), contact_kinds(), sweep_kinds(),
                                         pair_kinds(), blob_kinds(), scene_kinds()}) {
            all.insert(all.end(), family.begin(), family.end());
        }
        return all;
    }();
    return kinds;
}

bool holds(Range range, std::span<const double> values) {
    const auto all = [values](auto is) { return std::all_of(values.begin(), values.end(), is); };
    const bool are_finite = all([](double value) { return std::isfinite(value); });
    switch (range) {
        case Range::finite:
        case Range::apart:
            return are_finite;
        case Range::number:
            return all([](double value) { return !std::isnan(value); });
        case Range::size:
            return all([](double value) { return value >= 0.0; });
        case Range::finite_size:
            return are_finite && all([](double value) { return value >= 0.0; });
        case Range::direction:
            return are_finite && !all([](double value) { return value == 0.0; });
        case Range::factor:
            return are_finite && all([](double value) { return value > 0.0; });
    }
    return true;
}

const char* describe(Range range) {
    constexpr const char* words[] = {
        "finite",
        "a number, which may be inf or -inf",
        "0 or more, which may be inf",
        "0 or more, and finite",
        "finite, and long enough not to round to length zero",
        "finite, and another point than the one before",
        "above 0, and finite",
    };
    return words[static_cast<std::size_t>(range)];
}

}  // namespace espalier::tools
