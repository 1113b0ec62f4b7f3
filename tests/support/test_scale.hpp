// How much work a claim does: little by default, as much as one asks for before a release.
#pragma once

#include <cstdint>

namespace espalier::tests {

/// `count` times the environment's ESPALIER_TEST_SCALE (1 without it), an eighth of that under the sanitizers, at least
/// 1.
std::uint64_t scaled(std::uint64_t count);

}  // namespace espalier::tests
