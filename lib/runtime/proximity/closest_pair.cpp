// The walk to the closest pair, and how shapes bound their distance from boxes. Bounds only ever reject: what they let
// through is decided exactly (docs/numerics.md).
#include <bit>

#include <runtime/blob/duplicate_references.hpp>
#include <runtime/proximity/closest_pair.hpp>
#include <runtime/proximity/triangle_gap.hpp>
#include <runtime/traversal/box_nodes.hpp>
#include <runtime/traversal/scalar_walk.hpp>

namespace espalier::detail {
namespace {

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
            keys[child] = shape.squared_bound(shape, low, high, limit);
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
        return shape.squared_bound(shape, low, high, limit);
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
        if (answer.rules_out(0.0f, found.index)) return Visit::next;  // none is nearer
        found.distance = shape.distance_to(shape.segment, triangle);
        if (answer.rules_out(found.distance.squared, found.index) ||
            !shape.is_within_radius(shape.segment, triangle, found.distance, shape.radius))
            return Visit::next;
        found.triangle = triangle;
        return answer.take(found);
    }
};

/// The same for triangles as they lie: larger cores take longer to order them than to decide on boxes.
struct NearInStorageOrder {
    const NearShape& near;

    template <class Node>
    unsigned cull(const Node& node, float limit, float* keys) const {
        return near.cull(node, limit, keys);
    }
    template <class Leaf>
    Visit decide(const Leaf& leaf, unsigned slot, const LatticeTriangle& triangle, Answer& answer) const {
        float bound = near.bound(triangle, answer.limit);
        if (bound <= answer.limit) bound = near.tighten(triangle, bound, answer.limit);
        return bound <= answer.limit ? near.decide(leaf, slot, triangle, bound, answer) : Visit::next;
    }
};

/// Apart, so that its walk does not lie on the stack together with the other one.
ESPALIER_NOINLINE void find_in_storage_order(const BlobData& blob, const NearShape& near, Answer& answer) {
    NearInStorageOrder as_they_lie = {near};
    scalar_walk::find_nearest_first(blob, as_they_lie, answer);
}

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
float bound_of_segment(const DistantShape& shape, const float* low, const float* high, float limit) {
    const RoundedSegment& segment = shape.segment;
    const auto& across = static_cast<const DistantSegment&>(shape).across;
    const float* from = segment.from_steps;
    float least[3], most[3];
    for (int k = 0; k < 3; ++k) {
        least[k] = minimum(from[k], segment.to_steps[k]);
        most[k] = maximum(from[k], segment.to_steps[k]);
    }
    float bound = squared_gap(least, most, low, high);
    if (bound > limit) return bound;
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

}  // namespace

void find_nearest(const BlobData& blob, const DistantShape& shape, Answer& answer) {
    NearShape near = {blob, shape, reach_from(blob, shape.segment.from_steps)};
    answer.limit = shape.radius * shape.radius * distance_slack;
    if (takes_shortcut(shape.is_box)) return find_in_storage_order(blob, near, answer);
    scalar_walk::find_nearest_first(blob, near, answer);
}

void prepare(DistantSegment& shape) noexcept {
    const RoundedSegment& segment = shape.segment;
    float along[3];
    for (int k = 0; k < 3; ++k) along[k] = to_float(segment.to[k] - segment.from[k]);
    for (int axis = 0; axis < 3; ++axis) {
        const int y = axis == 2 ? 0 : axis + 1, z = axis == 0 ? 2 : axis - 1;
        const float squared = along[y] * along[y] + along[z] * along[z];
        const float inverse = squared > 0.0f ? 1.0f / square_root(squared) : 0.0f;
        shape.across[axis][axis] = 0.0f;
        shape.across[axis][y] = along[z] * inverse;
        shape.across[axis][z] = -along[y] * inverse;
    }
    shape.is_box = false;
    shape.squared_bound = bound_of_segment;
    shape.distance_to = distance_to;
    shape.is_within_radius = is_within_radius;
}

void prepare(DistantBox& shape) noexcept {
    shape.is_box = true;
    shape.squared_bound = [](const DistantShape& self, const float* low, const float* high, float) {
        return squared_gap(self.segment.from_steps, self.segment.to_steps, low, high);
    };
    shape.distance_to = distance_to_box;
    shape.is_within_radius = is_within_radius_of_box;
}

}  // namespace espalier::detail
