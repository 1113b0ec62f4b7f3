// Counting crossings: the kernel and the walk. The proof is in docs/numerics.md.

#include <runtime/blob/duplicate_references.hpp>
#include <runtime/kernels/point_triangle.hpp>
#include <runtime/proximity/winding.hpp>
#include <runtime/traversal/box_nodes.hpp>
#include <runtime/traversal/find.hpp>

namespace espalier::detail {
namespace {

/// A corner seen from the point: across the ray and along it.
struct FromRay {
    std::int64_t y, z;
    std::int64_t along;
};

FromRay from_ray(const WindingRay& ray, const std::int32_t* corner) {
    const auto& [axis, up] = ray.direction;
    const auto from_origin = [&](int k) { return (std::int64_t{corner[k]} << ray.fraction_bits) - ray.origin[k]; };
    const std::int64_t along = from_origin(axis);
    return {from_origin((axis + 1) % 3), from_origin((axis + 2) % 3), up ? along : -along};
}

/// On which side of the line from a to b the ray passes, 1 or -1; 0 only when a and b are one point. A ray that meets
/// the line counts as moved by a little along z, and by far less against y.
int side_of(const FromRay& a, const FromRay& b, std::int64_t area) {
    const std::int64_t side = area != 0 ? area : a.y != b.y ? b.y - a.y : b.z - a.z;
    return side > 0 ? 1 : side < 0 ? -1 : 0;
}

/// What the crossings of all triangles add up to; a point on one of them ends it.
struct SumOfCrossings : Answer {
    Winding sum;

    Visit take(const Winding& of_triangle) {
        sum.number += of_triangle.number;
        sum.on_surface = of_triangle.on_surface;
        return sum.on_surface ? Visit::stop : Visit::next;
    }
};

struct WindingShape {
    const BlobData& blob;
    const WindingRay& ray;
    const IntegerBounds& way;

    template <class Node>
    unsigned cull(const Node& node, float, float*) const {
        return children_within(node, blob.bits, way);
    }
    template <class Leaf>
    Visit decide(const Leaf& leaf, unsigned slot, const LatticeTriangle& triangle, SumOfCrossings& answer) const {
        bool is_around = true;
        for (int k = 0; k < 3; ++k) {
            const auto [low, high] = span_of(triangle, k);
            if (low > way.high[k] || high < way.low[k]) return Visit::next;
            is_around = is_around && (std::int64_t{low} << ray.fraction_bits) <= ray.origin[k] &&
                        (std::int64_t{high} << ray.fraction_bits) >= ray.origin[k];
        }
        if (is_around && distance_to(relative_to(ray, triangle), ray.fraction_bits).numerator.is_zero())
            return answer.take({0, true});
        const Winding winding = {crossing(ray, triangle), false};
        if constexpr (Leaf::may_have_duplicates) {
            const std::uint32_t index = scalar::storage_index(leaf, slot);
            if (winding.number != 0 && is_duplicate_reference(blob, index) && !is_first(index)) return Visit::next;
        }
        return answer.take(winding);
    }

private:
    [[nodiscard]] bool is_first(std::uint32_t index) const {
        return is_first_reference(blob, index, [&](const PlainNode& node, unsigned children) {
            return children_within(node, blob.bits, way) & children;
        });
    }
};

}  // namespace

std::int32_t crossing(const WindingRay& ray, const LatticeTriangle& triangle) noexcept {
    const FromRay a = from_ray(ray, triangle.corner[0]);
    const FromRay b = from_ray(ray, triangle.corner[1]);
    const FromRay c = from_ray(ray, triangle.corner[2]);
    const auto area = [](const FromRay& p, const FromRay& q) { return p.y * q.z - p.z * q.y; };
    const std::int64_t weight_a = area(b, c), weight_b = area(c, a), weight_c = area(a, b);
    const int side = side_of(b, c, weight_a);
    if (side == 0 || side_of(c, a, weight_b) != side || side_of(a, b, weight_c) != side) return 0;
    // Where the line meets the triangle, from the point on: the mean of the corners by these weights.
    Int128 along = multiply(a.along, weight_a) + multiply(b.along, weight_b) + multiply(c.along, weight_c);
    if (side < 0) along = -along;
    if (along.is_negative()) return 0;
    return ray.direction.up ? side : -side;
}

bool shortest_way_out(const BlobData& blob, const RoundedPoint& point, WindingRay& ray) noexcept {
    if (point.distance_offset != 0.0f) return false;
    std::int64_t shortest = INT64_MAX;
    for (int k = 0; k < 3; ++k) {
        const std::int64_t down = point.origin[k];
        const std::int64_t up = (std::int64_t{blob.extent[k]} << point.fraction_bits) - down;
        if (down < 0 || up < 0) return false;
        if (down < shortest) ray.direction = {k, false};
        shortest = down < shortest ? down : shortest;
        if (up < shortest) ray.direction = {k, true};
        shortest = up < shortest ? up : shortest;
        ray.origin[k] = point.origin[k];
    }
    ray.fraction_bits = point.fraction_bits;
    return true;
}

Winding winding_number(const BlobData& blob, const WindingRay& ray) noexcept {
    IntegerBounds way;
    for (int k = 0; k < 3; ++k) {  // what holds a point between two lattice planes reaches to both
        way.low[k] = static_cast<std::int32_t>(-(-ray.origin[k] >> ray.fraction_bits));
        way.high[k] = static_cast<std::int32_t>(ray.origin[k] >> ray.fraction_bits);
    }
    const int axis = ray.direction.axis;
    if (ray.direction.up) way.high[axis] = bounds_limit;
    else way.low[axis] = -bounds_limit;
    WindingShape shape = {blob, ray, way};
    SumOfCrossings answer;
    scalar::find_in_order(blob, shape, answer);
    return answer.sum;
}

}  // namespace espalier::detail
