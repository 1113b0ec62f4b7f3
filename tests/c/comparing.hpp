// What tests of espalier.h have in common: blobs, questions, and the comparison of C's answers with C++'s.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include <espalier/espalier.h>
#include <espalier/espalier.hpp>
#include <espalier/scene.hpp>

#include "asking.h"
#include "support/base/hostile_values.hpp"
#include "support/base/random.hpp"
#include "support/blobs/test_blobs.hpp"

namespace espalier::tests {

inline espalier_vec3 c(Vec3 v) { return {v.x, v.y, v.z}; }
std::vector<espalier_vec3> in_c(std::span<const Vec3> positions);

/// Makes a question whose points and lengths are near the blob or hostile.
question some_question(const Blob& blob, Random& random);

/// Makes a question near the instances of a scene, at least one, or hostile.
question some_question(const BakedScene& scene, Random& random);

/// Requires the same answers to every query of blobs from C and from C++.
void compare_all(const espalier_blob& c_blob, const espalier_blob& c_other, const Blob& blob, const Blob& other,
                 const question& asked);
/// Requires the same answers to every query of scenes from C and from C++.
void compare_scenes(const espalier_scene& c_scene, const BakedScene& scene, const question& asked);
/// Requires that changes, queries and pairs of a moving scene give the same from C and from C++.
void compare_moving_scenes(espalier_moving_scene& c_moving, const espalier_scene& c_baked, MovingScene& moving,
                           const BakedScene& baked, const question& asked);

/// Requires that refits of a deformable mesh, and what it returns about itself, are the same from C and from C++.
void compare_refits(espalier_deformable& c_mesh, Deformable& mesh, std::span<const Vec3> positions,
                    const question& asked);

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

espalier_blob open_from_c(std::span<const std::byte> bytes);

/// Has every optional section.
OpenedBlob blob_with_everything(Profile profile);

OpenedBlob blob_with_copies();

/// A scene that was opened from C and from C++, each side with arrays of its own.
struct SceneOfBoth {
    explicit SceneOfBoth(std::span<const std::byte> bytes);
    SceneOfBoth(const SceneOfBoth&) = delete;
    SceneOfBoth& operator=(const SceneOfBoth&) = delete;
    ~SceneOfBoth() = default;

    std::vector<espalier_blob> c_meshes;
    std::vector<espalier_scene> c_tiles;
    std::vector<Blob> meshes;
    std::vector<BakedScene> tiles;
    espalier_scene c_scene;
    espalier_open_status c_status;
    BakedScene scene;
};

std::vector<Instance> some_instances();
/// Bakes a scene of five meshes, one of each profile and one with duplicate references, and a tile of the same meshes.
std::vector<std::byte> bake_instances(std::span<const Instance> instances);

}  // namespace espalier::tests
