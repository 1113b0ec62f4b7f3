// What a claim says of how often it asked, in words that `tools/dev counts` and `tools/dev extremes` add up.
#pragma once

#include <cstdint>
#include <string>

namespace espalier::tests {

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
