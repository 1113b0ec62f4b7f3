// The bounding volumes that are compared: each fitted to the same points.
#pragma once

#include <baker/sections/half_spaces.hpp>

#include "../base.hpp"

namespace espalier::bench {

using baker::cross;
using baker::dot;
using baker::Point;

struct Ball {
    Point center{};
    double radius = 0.0;
};

/// Perpendicular axes of length 1.
struct Block {
    Point center{};
    std::array<Point, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    std::array<double, 3> half{};
};

/// Returns the least box along these axes, which are perpendicular and of length 1.
[[nodiscard]] Block box_along(const std::array<Point, 3>& axes, std::span<const Point> points);
[[nodiscard]] double area_of(const Block& block);
[[nodiscard]] double volume_of(const Block& block);

inline constexpr std::size_t slab_count = 13;
/// The normals of all slabs, not of length 1: 3 axes, 6 diagonals of a cube's faces, 4 of the cube.
extern const std::array<Point, slab_count> slab_directions;

struct Slabs {
    std::array<double, slab_count> lo{};
    std::array<double, slab_count> hi{};
};

/// A discrete orientation polytope (k-DOP) is what lies in all of its k / 2 slabs.
enum class Kind { sphere, aabb, obb, dop_14, dop_18, dop_26 };
inline constexpr std::array all_kinds = {Kind::sphere, Kind::aabb, Kind::obb, Kind::dop_14, Kind::dop_18, Kind::dop_26};

/// The slabs of a k-DOP: the axes and the diagonals of the cube (14), or of its faces (18), or both (26).
template <std::size_t k>
constexpr std::array<std::size_t, k / 2> dop_slabs() {
    static_assert(k == 14 || k == 18 || k == 26);
    std::array<std::size_t, k / 2> slabs{};
    for (std::size_t i = 0; i < k / 2; ++i) slabs[i] = k == 14 && i >= 3 ? i + 6 : i;
    return slabs;
}

struct Volumes {
    Ball ball;
    Block aligned;
    Block oriented;
    Slabs slabs;
};

/// Fits a volume of each kind to the same points.
[[nodiscard]] Volumes fit_volumes(std::span<const Point> points);

struct Extent {
    double area = 0.0;
    double volume = 0.0;
};
/// Returns the surface area and the volume of a kind.
[[nodiscard]] Extent extent_of(Kind kind, const Volumes& volumes);

// The bounding volumes as nodes store them: in float, larger than what they are fitted to by a margin.

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

inline void store(const Block& from, double margin, StoredAabb& to) {
    store(from.center, to.center);
    for (std::size_t i = 0; i < 3; ++i) to.half[i] = static_cast<float>(from.half[i] + margin);
}
inline void store(const Volumes& from, double margin, StoredAabb& to) { store(from.aligned, margin, to); }

inline void store(const Block& from, double margin, StoredObb& to) {
    store(from.center, to.center);
    for (std::size_t i = 0; i < 3; ++i) {
        store(from.axes[i], to.axes[i]);
        to.half[i] = static_cast<float>(from.half[i] + margin);
    }
}
inline void store(const Volumes& from, double margin, StoredObb& to) { store(from.oriented, margin, to); }

template <std::size_t k>
void store(const Volumes& from, double margin, StoredDop<k>& to) {
    for (std::size_t i = 0; i < k / 2; ++i) {
        const std::size_t slab = StoredDop<k>::slabs[i];
        const double along = margin * std::sqrt(dot(slab_directions[slab], slab_directions[slab]));
        to.reach[i] = static_cast<float>(from.slabs.hi[slab] + along);
        to.reach[i + k / 2] = static_cast<float>(along - from.slabs.lo[slab]);
    }
}

// The tests of triangles that a walk makes in leaves, in double.

struct Line {
    Point origin;
    Point direction;
};

/// x -> rotation x + shift; the rotation's rows.
struct Pose {
    std::array<Point, 3> rotation;
    Point shift;

    [[nodiscard]] Point turned(const Point& p) const {
        return {dot(rotation[0], p), dot(rotation[1], p), dot(rotation[2], p)};
    }
    [[nodiscard]] Point operator()(const Point& p) const { return turned(p) + shift; }
};

using Corners3 = std::array<Point, 3>;
[[nodiscard]] std::optional<double> meets(const Corners3& triangle, const Line& line);
[[nodiscard]] bool touches(const Corners3& triangle, const Ball& ball);
[[nodiscard]] bool touch(const Corners3& a, const Corners3& b);

// Whether a triangle touches an axis-aligned box.

/// A box, prepared for the test of "Fast 3D triangle-box overlap testing" (Akenine-Möller 2001), in double: the axes of
/// the box, the triangle's normal, and the nine cross products of edges. Touching counts.
class TriangleBoxTest {
public:
    explicit TriangleBoxTest(const Aabb& box);
    [[nodiscard]] bool touches(const Corners3& triangle) const;

private:
    Point center_;
    Point half_;
};

}  // namespace espalier::bench
