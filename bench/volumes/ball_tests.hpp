// A ball against each kind of volume.
#pragma once

#include <algorithm>
#include <cmath>

#include "ray_tests.hpp"

namespace espalier::bench {

/// A ball that is tested against volumes of one kind.
template <class Stored>
class PreparedBall {
public:
    explicit PreparedBall(const Ball& ball) : radius_(static_cast<float>(ball.radius)) { store(ball.center, center_); }
    [[nodiscard]] bool touches(const StoredSphere& sphere) const {
        float out[3];
        for (int i = 0; i < 3; ++i) out[i] = center_[i] - sphere.center[i];
        const float reach = sphere.radius + radius_;
        return dot3(out, out) <= reach * reach;
    }
    [[nodiscard]] bool touches(const StoredAabb& box) const {
        float out[3];
        for (int i = 0; i < 3; ++i) out[i] = center_[i] - box.center[i];
        return is_near(out, box.half);
    }
    [[nodiscard]] bool touches(const StoredObb& box) const {
        float out[3], along[3];
        for (int i = 0; i < 3; ++i) out[i] = center_[i] - box.center[i];
        for (int i = 0; i < 3; ++i) along[i] = dot3(box.axes[i], out);
        return is_near(along, box.half);
    }

private:
    /// Tests the distance of a box whose middle is `out` away, along the axes of the box.
    [[nodiscard]] bool is_near(const float (&out)[3], const float (&half)[3]) const {
        float beyond[3];
        for (int i = 0; i < 3; ++i) beyond[i] = std::max(std::abs(out[i]) - half[i], 0.0f);
        return dot3(beyond, beyond) <= radius_ * radius_;
    }
    float center_[3], radius_;
};

/// Tests k / 2 intervals: in those of a k-DOP, a ball is a k-DOP.
template <std::size_t k>
class PreparedBall<StoredDop<k>> {
public:
    explicit PreparedBall(const Ball& ball) {
        for (std::size_t i = 0; i < k / 2; ++i) {
            const Point& normal = slab_directions[StoredDop<k>::slabs[i]];
            const double along = dot(normal, ball.center), radius = ball.radius * std::sqrt(dot(normal, normal));
            reach_[i] = static_cast<float>(along + radius);
            reach_[i + k / 2] = static_cast<float>(radius - along);
        }
    }
    [[nodiscard]] bool touches(const StoredDop<k>& dop) const {
        for (std::size_t i = 0; i < k / 2; ++i)
            if (dop.reach[i] + reach_[i + k / 2] < 0.0f || reach_[i] + dop.reach[i + k / 2] < 0.0f) return false;
        return true;
    }

private:
    float reach_[k];
};

}  // namespace espalier::bench
