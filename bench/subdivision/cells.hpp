// What a subdivision of space shares: triangles that are referenced from several cells, and mailboxes that keep a query
// from testing one of them again.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "../deformation/box_tree.hpp"
#include "../exactness/kernels.hpp"
#include "../ladder/triangle_box.hpp"
#include "../traversal/corners.hpp"

namespace espalier::bench {

/// What queries count, added up.
struct CellWork {
    std::uint64_t cells = 0;  ///< visited, or nodes
    std::uint64_t triangle_tests = 0;
};

/// A number for each triangle: the last query that tested it (Arnaldi, Priol, Bouatouch 1987).
class Mailboxes {
public:
    explicit Mailboxes(std::size_t triangles) : last_(triangles, 0) {}

    void begin_query() { ++query_; }
    /// Returns whether the triangle has not been tested by this query, and marks it.
    [[nodiscard]] bool take(std::uint32_t triangle) {
        if (last_[triangle] == query_) return false;
        last_[triangle] = query_;
        return true;
    }
    [[nodiscard]] std::size_t bytes() const { return last_.size() * sizeof(std::uint32_t); }

private:
    std::vector<std::uint32_t> last_;
    std::uint32_t query_ = 0;
};

/// By how much cells count as larger when triangles are put into them, as a share of the largest coordinate. A ray that
/// floats lead past the corner of a cell then finds its triangles in the next one.
inline constexpr float cell_margin_share = 0x1p-19f;

inline Aabb box_of(const FloatTriangle& triangle) {
    Aabb box = Aabb::none();
    for (const Vec3& corner : triangle) box.add(corner);
    return box;
}

inline Aabb box_of(std::span<const FloatTriangle> triangles) {
    Aabb box = Aabb::none();
    for (const FloatTriangle& triangle : triangles) box.add(box_of(triangle));
    return box;
}

inline float largest_coordinate(const Aabb& box) {
    float largest = 0.0f;
    for (std::size_t k = 0; k < 3; ++k) largest = std::max({largest, std::abs(box.low[k]), std::abs(box.high[k])});
    return largest;
}

inline Aabb grown(Aabb box, float margin) {
    for (std::size_t k = 0; k < 3; ++k) box.low[k] -= margin, box.high[k] += margin;
    return box;
}

/// A test of a ray and a triangle that rounds to floats.
using FloatTest = MollerTrumbore<float>;

/// A ray as slabs take it: the inverse of a direction of 0 is a large number.
struct FloatRay {
    explicit FloatRay(const Ray& ray)
        : line{point_of(ray.origin), point_of(ray.direction)},
          origin{ray.origin.x, ray.origin.y, ray.origin.z},
          direction{ray.direction.x, ray.direction.y, ray.direction.z} {
        for (std::size_t k = 0; k < 3; ++k)
            inverse[k] = 1.0f / std::copysign(std::max(std::abs(direction[k]), 1e-18f), direction[k]);
        FloatTest::prepare(ray, prepared);
    }
    /// Returns t of the hit of triangle `index`, or infinity.
    [[nodiscard]] double hit(const FloatTriangle& triangle, std::size_t index, const FloatTest* float_test) const {
        if (float_test != nullptr) return static_cast<double>(float_test->test(prepared, index));
        return meets(corners_of(triangle), line).value_or(std::numeric_limits<double>::infinity());
    }
    /// Returns whether it meets the box, and where it enters and leaves it.
    [[nodiscard]] bool meets_box(const Aabb& box, float& enter, float& leave) const {
        enter = 0.0f, leave = std::numeric_limits<float>::infinity();
        for (std::size_t k = 0; k < 3; ++k) {
            const float one = (box.low[k] - origin[k]) * inverse[k], other = (box.high[k] - origin[k]) * inverse[k];
            enter = std::max(enter, std::min(one, other));
            leave = std::min(leave, std::max(one, other));
        }
        return enter <= leave;
    }

    Line line;
    FloatTest::Prepared prepared;
    std::array<float, 3> origin, direction, inverse{};
};

}  // namespace espalier::bench
