// Espalier's part: where all bodies are, which of them touch, and rays. The town is a baked scene beside them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <espalier/espalier.hpp>

namespace falling {

/// How many pairs have begun and ended.
struct Changes {
    std::uint32_t begun = 0;
    std::uint32_t ended = 0;
};

/// What World::restore() continues with: the bytes of the moving scene, the pairs of the last step, and the number of
/// steps, on which the next repack depends.
struct Snapshot {
    std::vector<std::byte> bytes;
    std::vector<espalier::InstancePair> pairs;
    std::uint32_t steps;
};

/// What a ray hits first.
enum class Below : std::uint8_t { nothing, body, town };

/// A body touches an instance of the town.
struct Touch {
    std::uint32_t body;     ///< Instance::user
    espalier::Vec3 normal;  ///< of the instance, where it is nearest to the body's middle
};

/// Its calls throw std::runtime_error if Espalier refuses one.
class World {
public:
    World(std::span<const espalier::Blob> meshes, const espalier::BakedScene& town, std::uint32_t capacity);

    espalier::InstanceHandle insert(std::uint32_t mesh, const espalier::Transform& place, std::uint32_t user);
    /// Ends the pairs of the instance, too.
    void remove(espalier::InstanceHandle instance);
    /// Moves instances, all in one batch, and renews the tree.
    void move(std::span<const espalier::Movement> movements);

    /// Finds the pairs that touch and compares them with those of the step before.
    std::span<const espalier::InstancePair> find_pairs();
    /// Finds what touches the town.
    const std::vector<Touch>& find_touches();
    /// Returns what is below an instance.
    [[nodiscard]] Below look_down(espalier::InstanceHandle instance) const;

    /// Returns the changes since the last call.
    Changes take_changes();
    [[nodiscard]] std::uint32_t user_of(std::uint32_t slot) const;
    [[nodiscard]] std::span<const std::byte> bytes() const { return scene_.bytes(); }
    [[nodiscard]] Snapshot snapshot() const;
    void restore(const Snapshot& snapshot);

private:
    /// An address that the block may begin at.
    struct alignas(32) Unit {
        std::byte bytes[32];
    };
    [[nodiscard]] espalier::Instance instance_in(std::uint32_t slot) const;

    std::vector<Unit> block_;
    espalier::MovingScene scene_;
    const espalier::BakedScene& town_;
    std::vector<espalier::InstancePair> pairs_, room_;
    std::vector<espalier::BakedPair> room_of_town_;
    std::vector<Touch> touches_;
    Changes changes_;
    std::uint32_t steps_ = 0;
};

}  // namespace falling
