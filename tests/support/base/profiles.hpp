// Claims that hold in every profile, tried in every profile.
#pragma once

#include <array>
#include <string>

#include <doctest/doctest.h>

#include <espalier/bake.hpp>

#include "test_scale.hpp"

namespace espalier::tests {

inline constexpr std::array every_profile = {Profile::fast, Profile::balanced, Profile::small, Profile::tiny};

inline std::string name_of(Profile profile) {
    constexpr const char* names[] = {"fast", "balanced", "small", "tiny"};
    return names[static_cast<std::size_t>(profile)];
}

inline constexpr std::array every_effort = {Effort::fast, Effort::normal, Effort::best};

inline BakeOptions with_profile(Profile profile, BakeOptions options = {}) {
    options.profile = profile;
    return options;
}

/// Returns options that store every optional section but materials, which a blob has if its mesh has them.
inline BakeOptions with_every_section(Profile profile) {
    BakeOptions options = {.profile = profile, .original_ids = true, .flat_angle = 5.0, .bounds = {true, true, true}};
    return options;
}

/// Returns options with which large triangles lie in several leaves.
inline BakeOptions with_copies() {
    return {.profile = Profile::fast, .build = {.builder = Builder::spatial_splits, .duplicate_budget = 1.0}};
}

/// What a failure says besides is which profile it was.
template <class Call>
void for_each_profile(Call call) {
    for (const Profile profile : every_profile) {
        const std::string name = name_of(profile);
        CAPTURE(name);
        call(profile);
    }
}

/// `scaled`, shared among the profiles: a claim that is tried in each of them takes no longer than it would in one.
inline std::uint64_t scaled_share(std::uint64_t count) {
    return (scaled(count) + every_profile.size() - 1) / every_profile.size();
}

}  // namespace espalier::tests
