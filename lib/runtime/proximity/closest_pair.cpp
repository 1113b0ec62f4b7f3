// The walk to the closest pair, and how shapes bound their distance from boxes. Bounds only ever reject: what they let
// through is decided exactly (docs/numerics.md).
#include <bit>

#include <runtime/blob/duplicate_references.hpp>
#include <runtime/lanes/select.hpp>
#include <runtime/proximity/closest_pair.hpp>
#include <runtime/proximity/point_queries.hpp>
#include <runtime/proximity/triangle_gap.hpp>
#include <runtime/traversal/box_nodes.hpp>
#include <runtime/traversal/find.hpp>

namespace espalier::detail {
namespace {

/// Between two boxes, the one given by its corners.
float squared_gap(const float* box_low, const float* box_high, const float* low, const float* high) {
    float squared = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const float gap = maximum(maximum(low[k] - box_high[k], box_low[k] - high[k]), 0.0f);
        squared += gap * gap;
    }
    return squared;
}

/// The most of the gaps that box and segment leave along the axes, all three together, and along a direction across the
/// segment and one axis: of the separating axes of boxes and segments (Gottschalk, Lin and Manocha 1996), the only
/// ones.
float squared_bound(const DistantShape& shape, const float* low, const float* high, float limit) {
    const auto& across = shape.across;
    const float* from = shape.segment.from_steps;
    float bound = squared_gap(shape.lowest, shape.highest, low, high);
    if (shape.is_box || bound > limit) return bound;
    float middle[3], size[3], reach[3];
    for (int k = 0; k < 3; ++k) {
        const float to_low = low[k] - from[k], to_high = high[k] - from[k];
        middle[k] = to_low + to_high;  // all of these twice as large as they should be
        size[k] = high[k] - low[k];
        reach[k] = absolute(to_low) + absolute(to_high);
    }
    for (int axis = 0; axis < 3; ++axis) {
        const int y = axis == 2 ? 0 : axis + 1, z = axis == 0 ? 2 : axis - 1;
        const float at_y = across[axis][y], at_z = across[axis][z];
        const float length_y = absolute(at_y), length_z = absolute(at_z);
        const float apart = absolute(at_y * middle[y] + at_z * middle[z]);
        const float covered = length_y * size[y] + length_z * size[z];
        const float slack = (length_y * reach[y] + length_z * reach[z]) * 0x1p-19f;
        const float gap = maximum((apart - covered) - slack, 0.0f) * 0.5f;
        bound = maximum(gap * gap, bound);
    }
    return bound;
}

/// Between the plane of a triangle and all that is between two points; of a box its corners farthest apart across the
/// plane. Squared; 0 where that is not clear.
float squared_gap_to_plane(const DistantShape& shape, const LatticeTriangle& triangle) {
    const float* from = shape.segment.from_steps;
    const float* to = shape.segment.to_steps;
    const auto& c = triangle.corner;
    const auto edge = [&](int end, int k) { return static_cast<float>(c[end][k] - c[0][k]); };
    float from_side = 0.0f, to_side = 0.0f, slack = 0.0f, squared_length = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const int y = k == 2 ? 0 : k + 1, z = k == 0 ? 2 : k - 1;
        const float plus = edge(1, y) * edge(2, z), minus = edge(1, z) * edge(2, y);
        const float normal = plus - minus, size = absolute(plus) + absolute(minus);
        const bool backward = shape.is_box && normal < 0.0f;
        const float corner = static_cast<float>(c[0][k]);
        const float to_from = (backward ? to : from)[k] - corner, to_to = (backward ? from : to)[k] - corner;
        from_side += normal * to_from;
        to_side += normal * to_to;
        slack += size * (absolute(to_from) + absolute(to_to));
        const float length = absolute(normal) + size * 0x1p-22f;
        squared_length += length * length;
    }
    if ((from_side < 0.0f) != (to_side < 0.0f)) return 0.0f;
    const float nearer = minimum(absolute(from_side), absolute(to_side)) - slack * 0x1p-20f;
    if (!(nearer > 0.0f)) return 0.0f;
    const float gap = nearer / square_root(squared_length);
    return gap * gap;
}

struct NearShape {
    const BlobData& blob;
    const DistantShape& shape;
    float reach;

    template <class Node>
    unsigned cull(const Node& node, float limit, float* keys) const {
        unsigned mask = 0;
        for (unsigned left = all_children(node); left != 0; left &= left - 1) {
            const auto child = static_cast<unsigned>(std::countr_zero(left));
            float low[3], high[3];
            for (int k = 0; k < 3; ++k) {
                low[k] = static_cast<float>(node.low(k, child, blob.bits));
                high[k] = static_cast<float>(node.high(k, child, blob.bits));
            }
            keys[child] = squared_bound(shape, low, high, limit);
            mask |= (keys[child] <= limit ? 1u : 0u) << child;
        }
        return mask;
    }
    [[nodiscard]] float bound(const LatticeTriangle& triangle, float limit) const {
        float low[3], high[3];
        for (int k = 0; k < 3; ++k) {
            const Span span = span_of(triangle, k);
            low[k] = static_cast<float>(span.low);
            high[k] = static_cast<float>(span.high);
        }
        return squared_bound(shape, low, high, limit);
    }
    [[nodiscard]] float tighten(const LatticeTriangle& triangle, float bound, float limit) const {
        bound = maximum(squared_gap_to_plane(shape, triangle), bound);
        return shape.is_box || bound > limit
                   ? bound
                   : maximum(squared_gap_to_segment(triangle, shape.segment.from_steps, shape.segment.to_steps, reach),
                             bound);
    }
    template <class Leaf>
    Visit decide(const Leaf& leaf, unsigned slot, const LatticeTriangle& triangle, float, Answer& answer) const {
        FoundPair found;
        static_cast<Found&>(found) = found_at(leaf, scalar::storage_index(leaf, slot));
        return shape.decide(triangle, found, answer);
    }
};

}  // namespace

void find_nearest(const BlobData& blob, const DistantShape& shape, Answer& answer) {
    float reach = reach_from(blob, shape.segment.from_steps);
    answer.limit = shape.radius * shape.radius * distance_slack;
    if constexpr (small_code) {
        NearShape near = {blob, shape, reach};
        scalar::find_nearest_first(blob, near, answer);
    } else {
        for (int k = 0; k < 3; ++k) reach += shape.highest[k] - shape.lowest[k];
        ESPALIER_DISPATCH(find_nearest_pair, blob, shape, reach, answer);
    }
}

namespace {

void prepare(DistantShape& shape, bool is_box) {
    const RoundedSegment& segment = shape.segment;
    shape.is_box = is_box;
    shape.distance_to = distance_to;
    shape.is_within_radius = is_within_radius;
    if (is_box) shape.distance_to = distance_to_box, shape.is_within_radius = is_within_radius_of_box;
    float along[3];
    for (int k = 0; k < 3; ++k) {
        along[k] = is_box ? 0.0f : to_float(segment.to[k] - segment.from[k]);
        shape.lowest[k] = minimum(segment.from_steps[k], segment.to_steps[k]);
        shape.highest[k] = maximum(segment.from_steps[k], segment.to_steps[k]);
    }
    for (int axis = 0; axis < 3; ++axis) {
        const int y = axis == 2 ? 0 : axis + 1, z = axis == 0 ? 2 : axis - 1;
        const float squared = along[y] * along[y] + along[z] * along[z];
        const float inverse = squared > 0.0f ? 1.0f / square_root(squared) : 0.0f;
        shape.across[axis][axis] = 0.0f;
        shape.across[axis][y] = along[z] * inverse;
        shape.across[axis][z] = -along[y] * inverse;
    }
}

}  // namespace

void prepare(DistantSegment& segment) noexcept { prepare(segment, false); }
void prepare(DistantBox& box) noexcept { prepare(box, true); }

}  // namespace espalier::detail
