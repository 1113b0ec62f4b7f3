// Segments in lattice steps: the nearest-first walk that rays take, with distances in steps for keys.
#include <bit>

#include <espalier/lattice.hpp>
#include <runtime/scalar_walk.hpp>
#include <runtime/whole_segment.hpp>

namespace espalier {

using namespace detail;

namespace {

template <class Leaf>
struct SegmentHits {
    const BlobData& blob;
    WholeSegment& segment;
    bool any_will_do;
    HitInSteps& hit;  ///< of no triangle before there is one
    Crossing first{};

    [[nodiscard]] float limit() const { return key_of(segment.steps_left); }

    template <class Node>
    unsigned children(const Node& node, float* keys) const {
        unsigned mask = children_within(node, blob.bits, segment.bounds);
        if (mask != 0) mask = children_on_line(segment, node, blob.bits, mask);
        const int axis = segment.longest;
        for (unsigned left = mask; left != 0; left &= left - 1) {
            const auto child = static_cast<unsigned>(std::countr_zero(left));
            const std::int32_t steps = segment.direction[axis] < 0
                                           ? segment.origin[axis] - node.high(axis, child, blob.bits)
                                           : node.low(axis, child, blob.bits) - segment.origin[axis];
            keys[child] = key_of(steps > 0 ? static_cast<std::uint32_t>(steps) : 0);
        }
        return mask;
    }

    Visit visit_leaf(const Leaf& leaf) {
        std::uint16_t beyond[Leaf::max_vertices];
        find_places(leaf, beyond);
        auto corners = scalar::corners_of(leaf);
        const auto used = leaf.used_slots();
        for (unsigned slot = 0; slot < leaf.slot_count; ++slot) {
            const scalar::CornerNumbers vertices = corners.next();
            if ((used >> slot & 1u) == 0 || (beyond[vertices.a] & beyond[vertices.b] & beyond[vertices.c]) != 0)
                continue;
            Crossing crossing;
            if (!crosses(segment, leaf.triangle(slot), crossing)) continue;
            offer(Triangle{scalar::owner_index(leaf, slot)}, crossing);
            if (any_will_do) return stop;
        }
        return keep_going;
    }

private:
    /// For each vertex a bit for each side of the bounds that it is beyond of, and for each side of the line, seen
    /// along two axes: a triangle all of whose corners are beyond the same one is not hit.
    void find_places(const Leaf& leaf, std::uint16_t* beyond) const {
        LineGrid grid;
        std::int32_t low[3], high[3];
        for (int k = 0; k < 3; ++k) {
            grid.base[k] = leaf.grid_base(k);
            grid.shift[k] = 0;
            low[k] = segment.bounds.low[k] - grid.base[k];
            high[k] = segment.bounds.high[k] - grid.base[k];
        }
        grid.bits = leaf.grid_bits();
        const LineSide sides[2] = {LineSide(segment, 1, grid), LineSide(segment, 2, grid)};
        for (unsigned vertex = 0; vertex < leaf.vertex_count; ++vertex) {
            std::int32_t at[3];
            unsigned places = 0;
            for (int k = 0; k < 3; ++k) {
                at[k] = leaf.anchor(k) - grid.base[k] + leaf.offset(k, vertex);
                places = places << 2 | (at[k] < low[k] ? 1u : 0u) | (at[k] > high[k] ? 2u : 0u);
            }
            for (const LineSide& side : sides) {
                const std::int32_t place = side.place(at[side.axis], at[segment.longest]);
                places = places << 2 | (side.is_below(place) ? 1u : 0u) | (side.is_above(place) ? 2u : 0u);
            }
            beyond[vertex] = static_cast<std::uint16_t>(places);
        }
    }

    /// Within the bounds nothing is farther than the whole length.
    [[nodiscard]] float key_of(std::uint32_t steps) const { return std::bit_cast<float>(steps << segment.key_shift); }

    void offer(Triangle triangle, const Crossing& crossing) {
        if (hit.triangle != no_triangle && !is_before(crossing, first) &&
            (is_before(first, crossing) || !(triangle < hit.triangle)))
            return;
        first = crossing;
        hit = {fixed_point(crossing), crossing.front ? Faces::front : Faces::back, triangle};
        segment.end_at(hit.t);
    }
};

QueryStatus find_hit(const Blob& blob, const SegmentInSteps& from_caller, bool any_will_do, HitInSteps& hit) {
    for (const Steps& end : {from_caller.from, from_caller.to})
        for (const std::int32_t coordinate : {end.x, end.y, end.z})
            if (coordinate < -max_segment_steps || coordinate > max_segment_steps) return QueryStatus::out_of_range;
    hit = {};
    WholeSegment segment;
    if (blob.triangle_count() == 0 || !segment.set(blob.data(), from_caller)) return QueryStatus::ok;
    scalar_walk::with_leaves_of(blob.data(), [&]<class Leaf>() {
        SegmentHits<Leaf> visitor = {blob.data(), segment, any_will_do, hit};
        scalar_walk::traverse_nearest_first<Leaf>(blob.data(), visitor);
    });
    return QueryStatus::ok;
}

}  // namespace

QueryStatus first_hit(const Blob& blob, const SegmentInSteps& segment, HitInSteps& hit) noexcept {
    return find_hit(blob, segment, false, hit);
}

QueryStatus any_hit(const Blob& blob, const SegmentInSteps& segment, bool& hit) noexcept {
    HitInSteps any;
    const QueryStatus status = find_hit(blob, segment, true, any);
    if (status == QueryStatus::ok) hit = any.triangle != no_triangle;
    return status;
}

}  // namespace espalier
