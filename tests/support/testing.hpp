// What nearly every test includes: doctest, the standard headers and the public ones, numbers, meshes and blobs to try,
// and how answers are compared. Where headers are precompiled, this one is.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <espalier/espalier.hpp>
#include <espalier/scenes/bake.hpp>

#include "support/base/hostile_values.hpp"
#include "support/base/profiles.hpp"
#include "support/base/random.hpp"
#include "support/base/same_bits.hpp"
#include "support/base/test_scale.hpp"
#include "support/base/vectors.hpp"
#include "support/blobs/test_blobs.hpp"
#include "support/meshes/makers.hpp"
#include "support/format/node_edits.hpp"
#include "support/queries/ray_maker.hpp"

namespace espalier::tests {

/// Ends the test case if there is a difference, and tells it.
inline void require_none(const std::optional<std::string>& difference) { REQUIRE_MESSAGE(!difference, *difference); }

/// Meshes that were made, not read.
inline constexpr const char* generated_meshes = "generated meshes";

inline std::string calls_made(const std::string& queries, const std::string& mesh, std::uint64_t random,
                              std::uint64_t adversarial) {
    return "calls of " + queries + " on " + mesh + ": " + std::to_string(random) + " random, " +
           std::to_string(adversarial) + " adversarial, held against the loop";
}

/// Of a kernel, for `tools/dev extremes` to add up.
inline std::string decisions_made(const std::string& kernel, std::uint64_t count) {
    return "decisions of " + kernel + ": " + std::to_string(count) + " yes or no, held against exact arithmetic";
}

}  // namespace espalier::tests
