// The values that options take, as people write them: names, lists of them, numbers, lengths and amounts of bytes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <espalier/bake.hpp>

#include <import/base/numbers.hpp>

#include "exit_code.hpp"

namespace espalier::tools {

template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

inline const Choices<Profile> profile_choices{
    {"fast", Profile::fast}, {"balanced", Profile::balanced}, {"small", Profile::small}, {"tiny", Profile::tiny}};
inline const Choices<Builder> builder_choices{{"binned_sah", Builder::binned_sah},
                                              {"sweep_sah", Builder::sweep_sah},
                                              {"spatial_splits", Builder::spatial_splits},
                                              {"agglomerative", Builder::agglomerative},
                                              {"linear", Builder::linear},
                                              {"insertion", Builder::insertion}};
inline const Choices<Effort> effort_choices{{"fast", Effort::fast}, {"normal", Effort::normal}, {"best", Effort::best}};
inline const Choices<Feature> feature_choices{{"face", Feature::face},         {"edge_ab", Feature::edge_ab},
                                              {"edge_bc", Feature::edge_bc},   {"edge_ca", Feature::edge_ca},
                                              {"vertex_a", Feature::vertex_a}, {"vertex_b", Feature::vertex_b},
                                              {"vertex_c", Feature::vertex_c}};

/// Largest leaf that a profile can hold; larger limits mean the same.
constexpr unsigned most_leaf_triangles(Profile profile) {
    constexpr unsigned most[] = {format::plain_leaf::max_triangles, format::strip_leaf::max_balanced_entries - 2,
                                 format::strip_leaf::max_small_entries - 2, format::predicted_strip::max_entries - 2};
    return most[static_cast<std::size_t>(profile)];
}

/// Whether `bake` takes the two together.
constexpr bool go_together(Profile profile, Builder builder) {
    return builder != Builder::spatial_splits || profile == Profile::fast;
}

/// The name that stands for the value; it is in the list.
template <class Value>
const std::string& name_in(const Choices<Value>& choices, Value value) {
    return std::find_if(choices.begin(), choices.end(), [&](const auto& choice) { return choice.second == value; })
        ->first;
}

/// The parts between commas, each once, in the order in which they come first.
std::vector<std::string> split_list(const std::string& input);

/// Numbers from `low` to `high`. Throws CommandError (usage) that names `option`.
std::vector<unsigned> parse_whole_numbers(const std::string& input, std::string_view option, unsigned low,
                                          unsigned high);
std::vector<float> parse_numbers(const std::string& input, std::string_view option, float low, float high);

/// Names out of `choices`, or "all". Throws CommandError (usage) that names `option`.
template <class Value>
std::vector<Value> parse_names(const std::string& input, std::string_view option, const Choices<Value>& choices) {
    std::vector<Value> result;
    for (const std::string& name : split_list(input)) {
        const std::size_t known = result.size();
        for (const auto& choice : choices)
            if (name == choice.first || name == "all") result.push_back(choice.second);
        if (result.size() == known) {
            throw_error(ExitCode::usage, option, ": '", printable(name), "' is none of all, ",
                        listed(choices, ", ", &Choices<Value>::value_type::first), ", with commas between.");
        }
    }
    return result;
}

/// Metres in one of the unit: m, km, cm, mm, um, in, ft. Nothing for any other name.
std::optional<double> metres_in(std::string_view unit);

/// The length in units of the asset, of which each is a metre unless the user scaled it. Throws CommandError (usage)
/// that names `option` when the text is no finite length.
double parse_length(const std::string& text, std::string_view option);

/// K is 1024 bytes, M 1024 K, G 1024 M; "KiB" and "KB" mean the same as K, and so on. Fractions are rounded down.
/// Throws CommandError (usage) that names `option` when the text is no such amount, or none above zero.
std::uint64_t parse_byte_size(const std::string& input, std::string_view option);

}  // namespace espalier::tools
