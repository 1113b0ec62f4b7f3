// How much work a claim does: little by default, as much as one asks for before a release.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace espalier::tests {

/// `count` times the environment's ESPALIER_TEST_SCALE (1 without it), an eighth of that under the sanitizers, at least
/// 1.
std::uint64_t scaled(std::uint64_t count);

/// Whether enough is asked that each kind of answer must come up: not under the sanitizers, nor at a scale below 1.
inline bool asks_enough() { return scaled(64) >= 64; }

/// Returns whether a claim about every case of a list tries every case: not at a scale below 1.
bool takes_every_case();

/// Returns how often a claim asks about one case of a list: `rounds` times, or an eighth of that at a scale below 1.
inline unsigned rounds_per_case(unsigned rounds) { return takes_every_case() ? rounds : (rounds + 7) / 8; }

/// The numbers below `count`, of which a scale below 1 takes only a random one of each `group` in a row. With a group
/// of eight bits this is a bit of each byte, so that every field of some bytes is met.
std::vector<std::size_t> sampled(std::size_t count, std::size_t group, std::uint64_t seed = 1);

}  // namespace espalier::tests
