// The names that options take, each list in the order in which help shows it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <espalier/bake.hpp>

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
    switch (profile) {
        case Profile::fast:
            return format::plain_leaf::max_triangles;
        case Profile::balanced:
            return format::strip_leaf::max_balanced_entries - 2;
        case Profile::small:
            return format::strip_leaf::max_small_entries - 2;
        case Profile::tiny:
            return format::predicted_strip::max_entries - 2;
    }
    return format::max_leaf_triangles;
}

/// Whether `bake` takes the two together.
constexpr bool go_together(Profile profile, Builder builder) {
    return builder != Builder::spatial_splits || profile == Profile::fast;
}

/// The name that stands for the value; it is in the list.
template <class Value>
const std::string& name_in(const Choices<Value>& choices, Value value) {
    for (const auto& choice : choices) {
        if (choice.second == value) return choice.first;
    }
    return choices.front().first;
}

}  // namespace espalier::tools
