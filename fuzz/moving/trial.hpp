// A moving scene with its memory and its model, and the calls that change it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <espalier/scenes/moving_scene.hpp>

#include "model.hpp"
#include "support/base/random.hpp"
#include "support/machine/aligned_buffer.hpp"

namespace espalier::fuzz {

/// The number of kinds of changes.
inline constexpr std::uint32_t change_kinds = 10;

class Trial {
public:
    /// An empty scene in memory of that size. It is not open if create_moving_scene() refuses an argument.
    Trial(std::uint32_t capacity, int step_exponent, std::size_t bytes);
    /// A copy of bytes from elsewhere. It is not open if open_moving_scene() refuses them.
    explicit Trial(std::span<const std::byte> snapshot);

    [[nodiscard]] MovingScene& scene() { return scene_; }
    [[nodiscard]] const Model& model() const { return model_; }
    /// Returns the size of an instance of 2^12 steps, around which the scripts place instances.
    [[nodiscard]] float unit() const;

    /// Calls one of the functions that change a scene with arguments that are drawn, valid or not.
    void change(std::uint32_t kind, tests::Random& random);
    /// Checks the scene against its model, and that a copy of its bytes opens.
    void check();

private:
    Transform any_transform(tests::Random& random) const;
    InstanceHandle any_handle(tests::Random& random) const;
    void insert_any(tests::Random& random);
    void remove_any(tests::Random& random);
    void move_any(tests::Random& random);
    void move_some(tests::Random& random);
    void set_any(tests::Random& random);
    void repack_all();
    /// Checks the status of a call about a handle, and that a refusal has changed nothing. Returns whether the handle
    /// is live.
    bool is_taken(InstanceHandle handle, QueryStatus status);
    void require_unchanged();

    tests::AlignedBuffer memory_;
    MovingScene scene_;
    Model model_;
    std::vector<std::byte> before_;  ///< the bytes before a change
};

}  // namespace espalier::fuzz
