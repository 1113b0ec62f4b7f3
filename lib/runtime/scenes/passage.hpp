// The space that a box passes through as it moves, against the boxes of instances: rays, sweeps and overlaps alike.
#pragma once

#include <cstdint>

#include <espalier/scene.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/scenes/shape_bounds.hpp>

namespace espalier::detail {

/// A box that moves along a line, widened by more than any query of an instance may move it by rounding. A child whose
/// box it does not meet holds nothing that the query finds (docs/numerics.md, Scenes).
///
/// Coordinates are steps of the scene's lattice. Keys and limits are scaled t: t times a power of two, for which the
/// displacement is between 1 and 2 steps long along the longest axis.
class Passage {
public:
    /// A box that stays where it is.
    Passage(const SceneData& scene, const ShapeBounds& bounds);
    /// A box that moves by a multiple of the displacement; `magnitude` is at least the largest coordinate of all of its
    /// way that matters.
    Passage(const SceneData& scene, const ShapeBounds& bounds, const Vec3& displacement, float magnitude);

    /// Returns the scaled t at which the moving box begins or ends to meet a plane of a box: product with inverse(k),
    /// plus the offset of the side.
    [[nodiscard]] float inverse(int k) const { return inverse_[k]; }
    [[nodiscard]] float near_offset(int k) const { return near_offset_[k]; }
    [[nodiscard]] float far_offset(int k) const { return far_offset_[k]; }
    /// Returns the key of a t that is not negative.
    [[nodiscard]] float key_of(float t) const;
    /// Returns what the slab test of an instruction set needs.
    template <class Lanes>
    [[nodiscard]] Lanes lanes(const BlobData& tree) const {
        Lanes lanes{};
        unsigned signs = 0;
        for (unsigned k = 0; k < 3; ++k) {
            lanes.set_inverse(tree, k, inverse_[k]);
            const float slack = absolute(inverse_[k]) * Lanes::box_slack(tree);
            lanes.near_offset[k] = near_offset_[k] - lanes.low(k) - slack;
            lanes.far_offset[k] = far_offset_[k] - lanes.low(k) + slack;
            signs |= (inverse_[k] < 0.0f ? 1u : 0u) << k;
        }
        lanes.tau_min = 0.0f;
        lanes.planes = Lanes::plane_orders()[signs];
        return lanes;
    }

private:
    float inverse_[3];      ///< scaled t for each step
    float near_offset_[3];  ///< scaled t at which the side ahead meets coordinate 0
    float far_offset_[3];   ///< scaled t at which the other side leaves coordinate 0
    std::int32_t t_exponent_ = 0;
};

}  // namespace espalier::detail
