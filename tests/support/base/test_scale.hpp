// How much work a claim does: little by default, as much as one asks for before a release.
#pragma once

#include <cstdint>

namespace espalier::tests {

/// `count` times the environment's ESPALIER_TEST_SCALE (1 without it), an eighth of that under the sanitizers, at least
/// 1.
std::uint64_t scaled(std::uint64_t count);

/// Whether enough is asked that each kind of answer must come up: not under the sanitizers, nor at a scale below 1.
inline bool asks_enough() { return scaled(64) >= 64; }

}  // namespace espalier::tests
