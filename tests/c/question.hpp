// What the arguments of a round of calls are made of: some of it near an asset, some of it hostile.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>

#include <espalier/espalier.h>
#include <espalier/espalier.hpp>

#include "support/base/hostile_values.hpp"
#include "support/base/random.hpp"

namespace espalier::tests {

struct question {
    Vec3 points[4];
    Vec3 directions[4];
    float lengths[4];
    float rotation[4];
    std::uint32_t bits;  // for triangles, counts, enumerations
};

/// Makes a question whose points and lengths are near the blob or hostile.
question some_question(const Blob& blob, Random& random);
/// Makes a question near the instances of a scene, at least one, or hostile.
question some_question(const BakedScene& scene, Random& random);

/// A value of which every bit is random, or every float or integer one that breaks careless code.
template <class T>
T any_bits(Random& random) {
    static_assert(sizeof(T) % 4 == 0 && std::is_trivially_copyable_v<T>);
    std::array<std::uint32_t, sizeof(T) / 4> words;
    for (std::uint32_t& word : words) {
        const auto any = static_cast<std::uint32_t>(random.next());
        const auto small = static_cast<std::uint32_t>(static_cast<std::int32_t>(any) >> random.below(32));
        const float hostile = hostile_values[random.below(hostile_values.size())];
        word = std::array{any, small, std::bit_cast<std::uint32_t>(hostile)}[random.below(3)];
    }
    return std::bit_cast<T>(words);
}

}  // namespace espalier::tests
