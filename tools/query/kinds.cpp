#include "kinds.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include <import/base/numbers.hpp>

namespace espalier::tools {

namespace {

/// An argument of the query: the words as they were typed, and their values.
struct Argument {
    std::string name;
    std::vector<std::string> words;
    std::vector<double> values;
    Range range;
};

double value_of_word(QueryWord::Type type, const std::string& word, const char* name, double origin) {
    using Type = QueryWord::Type;
    if (type == Type::place) return double(place_argument(word, name, origin));
    if (type == Type::length || type == Type::offset) return double(length_argument(word, name));
    if (type == Type::number) return double(number_argument(word, name));
    return parse_double(word).value_or(0.0);
}

bool has_range(const QueryWord& word) {
    if (word.type == QueryWord::Type::index) return word.range == Range::directions;
    return word.type != QueryWord::Type::name;
}

/// Names arguments of one name "vertex 2 of 5".
void number_equal_names(std::vector<Argument>& arguments) {
    std::vector<std::string> names;
    names.reserve(arguments.size());
    for (const Argument& argument : arguments) names.push_back(argument.name);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto same = std::count(names.begin(), names.end(), names[i]);
        const auto before = std::count(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]);
        if (same > 1) arguments[i].name = text(names[i], ' ', before + 1, " of ", same);
    }
}

std::vector<Argument> arguments_of(const QueryKind& kind, const QueryArguments& given, const Vec3d& origin) {
    std::vector<Argument> arguments;
    const auto add = [&](const char* name, QueryWord::Type type, std::vector<std::string> words, Range range) {
        Argument& argument = arguments.emplace_back(Argument{name, std::move(words), {}, range});
        for (std::string& word : argument.words) {
            word = typed(word);
            const std::size_t axis = argument.values.size();
            const double zero = axis == 0 ? origin.x : axis == 1 ? origin.y : origin.z;
            argument.values.push_back(value_of_word(type, word, name, zero));
        }
    };
    auto next = given.words.begin();
    for (const QueryWord* word : words_of(kind, given.words.size()).value_or(std::vector<const QueryWord*>())) {
        const auto end = next + word->count;
        if (has_range(*word)) add(word->name, word->type, {next, end}, word->range);
        next = end;
    }
    number_equal_names(arguments);

    using Type = QueryWord::Type;
    const auto takes = [&kind](QueryOption option) { return (kind.options & option) != 0; };
    if (takes(option_t_range)) {
        add("--t-min", Type::number, {given.t_min}, Range::number);
        add("--t-max", Type::number, {given.t_max}, Range::number);
    }
    if (takes(option_sweep)) add("--skin", Type::length, {given.skin}, Range::finite_size);
    if (takes(option_max_distance)) add("--max-distance", Type::length, {given.max_distance}, Range::size);
    if (takes(option_placement)) {
        add("--rotate", Type::number, given.rotation, Range::direction);
        add("--move", Type::length, given.translation, Range::finite);
        add("--scale", Type::number, {given.scale}, Range::factor);
    }
    return arguments;
}

/// Returns the argument that the query refuses. A length that rounds to zero has no other sign than the refusal.
const Argument* invalid_one(const std::vector<Argument>& arguments) {
    for (const Argument& argument : arguments)
        if (!holds(argument.range, argument.values)) return &argument;
    const auto may_be_short = [](const Argument& argument) {
        return argument.range == Range::direction || argument.range == Range::apart;
    };
    const bool is_one = std::count_if(arguments.begin(), arguments.end(), may_be_short) == 1;
    return is_one ? &*std::find_if(arguments.begin(), arguments.end(), may_be_short) : nullptr;
}

double size_of_word(const Argument& argument) {
    double size = 0.0;
    for (const double value : argument.values) size = std::max(size, std::fabs(value));
    return size;
}

/// Returns the argument that reaches farthest from the origin.
const Argument* farthest_one(const std::vector<Argument>& arguments) {
    const auto farthest = std::max_element(arguments.begin(), arguments.end(), [](const auto& a, const auto& b) {
        const bool counts = std::isfinite(size_of_word(b));  // an infinite one is valid where it stands
        return counts && (!std::isfinite(size_of_word(a)) || size_of_word(a) < size_of_word(b));
    });
    return farthest == arguments.end() ? nullptr : &*farthest;
}

/// Returns "radius is -1".
std::string stated(const Argument& argument) {
    return text(argument.name, " is ", listed(argument.words, " ", printable));
}

/// Returns how many times words are given of which the kind takes fewer, or nothing.
std::optional<std::size_t> too_many(const QueryKind& kind, const QueryArguments& given) {
    if (kind.repeats.which == Repeats::Which::none) return std::nullopt;
    const std::size_t repeated = kind.repeats.which == Repeats::Which::all ? word_count(kind) : kind.words.back().count;
    const std::size_t count = (given.words.size() - (word_count(kind) - repeated)) / repeated;
    return count > kind.repeats.most ? std::optional(count) : std::nullopt;
}

/// Returns what an argument is, and whether it takes units.
const char* meaning_of(const QueryWord& word) {
    if (word.meaning != nullptr) return word.meaning;
    constexpr const char* meanings[] = {
        "a length, which takes a unit",
        "a place in the coordinates of the source; each takes a unit",
        "of the plane dot(normal, x) = offset, in the coordinates of the source; takes a unit",
        "a direction, without units",
        "a whole number from 0 on",
        "a point of the lattice, in whole steps",
        "a name",
    };
    static_assert(std::size(meanings) == static_cast<std::size_t>(QueryWord::Type::name) + 1);
    if (word.type == QueryWord::Type::length && word.count == 3) return "a displacement; each length takes a unit";
    return meanings[static_cast<std::size_t>(word.type)];
}

const char* repeated_name(const QueryKind& kind) {
    return kind.repeats.which == Repeats::Which::all ? kind.words.front().name : kind.words.back().name;
}

}  // namespace

std::string words_text(const QueryKind& kind) {
    std::string result = listed(kind.words, ", ",
                                [](const QueryWord& word) { return text(word.name, word.count == 3 ? " x y z" : ""); });
    if (kind.repeats.which == Repeats::Which::all) result += "; once or more";
    if (kind.repeats.which == Repeats::Which::last) result += "; the last any number of times";
    return result;
}

std::string words_help(const QueryKind& kind) {
    std::string lines;
    for (std::size_t i = 0; i < kind.words.size(); ++i) {
        const QueryWord& word = kind.words[i];
        if (i != 0 && std::string_view(word.name) == kind.words[i - 1].name) continue;  // three half axes are alike
        const bool is_stated = has_range(word) && word.range != Range::finite;
        lines += text("  ", word.name, word.count == 3 ? " x y z: " : ": ", meaning_of(word),
                      is_stated ? text("; ", describe(word.range)) : std::string(), "\n");
    }
    return lines.empty() ? lines : "Arguments:\n" + lines;
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
        case Range::directions:
            return all([](double value) { return value >= 2.0 && value <= max_winding_directions; });
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
        "from 2 to 4096",
    };
    static_assert(max_winding_directions == 4096);
    return words[static_cast<std::size_t>(range)];
}

std::string reason_of(const QueryKind& kind, const QueryArguments& given, const Vec3d& origin, QueryStatus status) {
    if (status != QueryStatus::invalid_argument && status != QueryStatus::out_of_range) return describe(status);
    const std::vector<Argument> arguments = arguments_of(kind, given, origin);
    if (status == QueryStatus::out_of_range) {
        const Argument* farthest = farthest_one(arguments);
        return farthest == nullptr ? describe(status) : text(describe(status), "; ", stated(*farthest));
    }
    if (const auto count = too_many(kind, given))
        return text(repeated_name(kind), " is given ", *count, " times; ", kind.repeats.most, " is the most");
    const Argument* invalid = invalid_one(arguments);
    return invalid == nullptr ? describe(status) : text(stated(*invalid), "; it must be ", describe(invalid->range));
}

}  // namespace espalier::tools
