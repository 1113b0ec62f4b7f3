// The bounding volumes as nodes store them: in float, larger than what they are fitted to by a margin.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "shapes.hpp"

namespace espalier::bench {

/// The share of the largest coordinate by which volumes are larger: it covers what float rounds off in their tests, so
/// that no walk skips a volume that has a hit.
inline constexpr double stored_margin_share = 0x1p-18;

struct StoredSphere {
    static constexpr Kind kind = Kind::sphere;
    float center[3];
    float radius;
};

/// Three intervals: an axis-aligned bounding box.
struct StoredAabb {
    static constexpr Kind kind = Kind::aabb;
    float center[3];
    float half[3];
};

/// A box along axes of its own.
struct StoredObb {
    static constexpr Kind kind = Kind::obb;
    float axes[3][3];
    float center[3];
    float half[3];
};

/// k / 2 intervals: a k-DOP.
template <std::size_t k>
struct StoredDop {
    static constexpr Kind kind = k == 14 ? Kind::dop_14 : k == 18 ? Kind::dop_18 : Kind::dop_26;
    static constexpr std::size_t half_count = k / 2;
    static constexpr std::array<std::size_t, half_count> slabs = dop_slabs<k>();
    /// How far the polytope reaches along the normals, then along the opposite normals.
    float reach[k];
};

inline void store(const Point& p, float (&to)[3]) {
    to[0] = static_cast<float>(p.x);
    to[1] = static_cast<float>(p.y);
    to[2] = static_cast<float>(p.z);
}

inline void store(const Volumes& from, double margin, StoredSphere& to) {
    store(from.ball.center, to.center);
    to.radius = static_cast<float>(from.ball.radius + margin);
}

inline void store(const Volumes& from, double margin, StoredAabb& to) {
    store(from.aligned.center, to.center);
    for (std::size_t i = 0; i < 3; ++i) to.half[i] = static_cast<float>(from.aligned.half[i] + margin);
}

inline void store(const Volumes& from, double margin, StoredObb& to) {
    store(from.oriented.center, to.center);
    for (std::size_t i = 0; i < 3; ++i) {
        store(from.oriented.axes[i], to.axes[i]);
        to.half[i] = static_cast<float>(from.oriented.half[i] + margin);
    }
}

template <std::size_t k>
void store(const Volumes& from, double margin, StoredDop<k>& to) {
    for (std::size_t i = 0; i < k / 2; ++i) {
        const std::size_t slab = StoredDop<k>::slabs[i];
        const double along = margin * std::sqrt(dot(slab_directions[slab], slab_directions[slab]));
        to.reach[i] = static_cast<float>(from.slabs.hi[slab] + along);
        to.reach[i + k / 2] = static_cast<float>(along - from.slabs.lo[slab]);
    }
}

}  // namespace espalier::bench
