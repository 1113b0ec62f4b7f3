// What a claim says of how often it asked, in words that `tools/dev counts` adds up over profiles and claims.
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

}  // namespace espalier::tests
