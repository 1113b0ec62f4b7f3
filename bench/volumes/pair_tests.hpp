// A volume of one hierarchy against a volume of another one, which is placed. What is the same for all pairs is
// computed once for a pose, and what is the same for all pairs of a placed volume once for that volume.
#pragma once

#include <cmath>

#include "../traversal/pair_walk.hpp"
#include "dop_turn.hpp"
#include "ray_tests.hpp"

namespace espalier::bench {

/// A pose for volumes of one kind. `placed` returns a volume of the second hierarchy as tests take it, and `touch`
/// tests it against a volume of the first.
template <class Stored>
class PreparedPose;

inline void place(const Placement& placement, const float* p, float* to) {
    for (int i = 0; i < 3; ++i) to[i] = dot3(placement.rotation[i], p) + placement.shift[i];
}

/// Tests the distance of the centers.
template <>
class PreparedPose<StoredSphere> {
public:
    using Placed = StoredSphere;
    explicit PreparedPose(const Placement& placement) : placement_(&placement) {}
    [[nodiscard]] Placed placed(const StoredSphere& b) const {
        Placed moved;
        place(*placement_, b.center, moved.center);
        moved.radius = b.radius;
        return moved;
    }
    [[nodiscard]] bool touch(const StoredSphere& a, const Placed& b) const {
        float out[3];
        for (int i = 0; i < 3; ++i) out[i] = b.center[i] - a.center[i];
        const float reach = a.radius + b.radius;
        return dot3(out, out) <= reach * reach;
    }

private:
    const Placement* placement_;
};

/// Tests the 15 axes that can separate two boxes (Gottschalk, Lin, Manocha 1996): three of each, and the cross products
/// of these. `r` turns from the axes of b to those of a, `m` has its magnitudes, and `t` leads to the center of b.
inline bool boxes_touch(const float (&half_a)[3], const float (&half_b)[3], const float (&r)[3][3],
                        const float (&m)[3][3], const float (&t)[3]) {
    for (int i = 0; i < 3; ++i)
        if (std::abs(t[i]) > half_a[i] + dot3(m[i], half_b)) return false;
    for (int j = 0; j < 3; ++j)
        if (std::abs(t[0] * r[0][j] + t[1] * r[1][j] + t[2] * r[2][j]) >
            half_b[j] + m[0][j] * half_a[0] + m[1][j] * half_a[1] + m[2][j] * half_a[2])
            return false;
    for (int i = 0; i < 3; ++i) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        for (int j = 0; j < 3; ++j) {
            const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            if (std::abs(t[i2] * r[i1][j] - t[i1] * r[i2][j]) >
                half_a[i1] * m[i2][j] + half_a[i2] * m[i1][j] + half_b[j1] * m[i][j2] + half_b[j2] * m[i][j1])
                return false;
        }
    }
    return true;
}

/// A placed box is an oriented one, so all boxes of a hierarchy are turned alike.
template <>
class PreparedPose<StoredAabb> {
public:
    using Placed = StoredAabb;
    explicit PreparedPose(const Placement& placement) : placement_(&placement) {}
    [[nodiscard]] Placed placed(const StoredAabb& b) const {
        Placed moved = b;
        place(*placement_, b.center, moved.center);
        return moved;
    }
    [[nodiscard]] bool touch(const StoredAabb& a, const Placed& b) const {
        float t[3];
        for (int i = 0; i < 3; ++i) t[i] = b.center[i] - a.center[i];
        return boxes_touch(a.half, b.half, placement_->rotation, placement_->magnitude, t);
    }

private:
    const Placement* placement_;
};

/// Each pair of boxes has a rotation of its own.
template <>
class PreparedPose<StoredObb> {
public:
    using Placed = StoredObb;
    explicit PreparedPose(const Placement& placement) : placement_(&placement) {}
    [[nodiscard]] Placed placed(const StoredObb& b) const {
        Placed moved = b;
        place(*placement_, b.center, moved.center);
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) moved.axes[j][i] = dot3(placement_->rotation[i], b.axes[j]);
        return moved;
    }
    [[nodiscard]] bool touch(const StoredObb& a, const Placed& b) const {
        float out[3], t[3], r[3][3], m[3][3];
        for (int i = 0; i < 3; ++i) out[i] = b.center[i] - a.center[i];
        for (int i = 0; i < 3; ++i) {
            t[i] = dot3(a.axes[i], out);
            for (int j = 0; j < 3; ++j) {
                r[i][j] = dot3(a.axes[i], b.axes[j]);
                m[i][j] = std::abs(r[i][j]) + nearly_parallel;
            }
        }
        return boxes_touch(a.half, b.half, r, m, t);
    }

private:
    static constexpr float nearly_parallel = 1e-6f;  ///< for edges whose cross product is almost zero
    const Placement* placement_;
};

/// Encloses the second k-DOP in one with the normals of the first, and tests k / 2 intervals.
template <std::size_t k>
class PreparedPose<StoredDop<k>> {
public:
    using Placed = StoredDop<k>;
    explicit PreparedPose(const Placement& placement) : turn_(placement.exact) {}
    [[nodiscard]] Placed placed(const StoredDop<k>& b) const {
        Placed moved;
        turn_.enclose(b.reach, moved.reach);
        return moved;
    }
    [[nodiscard]] bool touch(const StoredDop<k>& a, const Placed& b) const {
        for (std::size_t i = 0; i < k / 2; ++i)
            if (a.reach[i] + b.reach[i + k / 2] < 0.0f || b.reach[i] + a.reach[i + k / 2] < 0.0f) return false;
        return true;
    }

private:
    DopTurn<k> turn_;
};

}  // namespace espalier::bench
