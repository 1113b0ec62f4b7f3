// Claims that hold in every profile, tried in every profile.
#pragma once

#include <array>
#include <string>

#include <doctest/doctest.h>

#include <espalier/bake.hpp>

#include "test_scale.hpp"

namespace espalier::tests {

inline constexpr std::array every_profile = {format::Profile::fast, format::Profile::balanced, format::Profile::small,
                                             format::Profile::tiny};

inline std::string name_of(format::Profile profile) {
    switch (profile) {
        case format::Profile::fast:
            return "fast";
        case format::Profile::balanced:
            return "balanced";
        case format::Profile::small:
            return "small";
        case format::Profile::tiny:
            return "tiny";
    }
    return "unknown";
}

inline BakeOptions with_profile(format::Profile profile, BakeOptions options = {}) {
    options.profile = profile;
    return options;
}

/// Asks for all that a blob may carry besides; the mesh has to have materials.
inline BakeOptions with_every_section(format::Profile profile) {
    BakeOptions options = with_profile(profile);
    options.original_ids = true;
    options.materials = Materials::bits_16;
    options.edge_flags = 5.0;
    options.bounds = {true, true, true};
    return options;
}

/// What a failure says besides is which profile it was.
template <class Call>
void for_each_profile(Call call) {
    for (const format::Profile profile : every_profile) {
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
