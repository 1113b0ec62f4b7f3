// Segments in lattice steps: the nearest-first walk that rays take, with distances in steps for keys.
#include <bit>

#include <espalier/advanced/lattice.hpp>
#include <runtime/rays/queries.hpp>
#include <runtime/rays/whole_segment.hpp>
#include <runtime/traversal/find.hpp>

namespace espalier {

using namespace detail;

namespace {

struct FoundCrossing : Found {
    Crossing crossing;

    [[nodiscard]] static float key() { return infinity; }              // crossings are compared exactly
    [[nodiscard]] static float limit(float before) { return before; }  // the shape sets it
};
bool comes_before(const FoundCrossing& a, const FoundCrossing& b) {
    return is_before(a.crossing, b.crossing) || (!is_before(b.crossing, a.crossing) && a.index < b.index);
}

struct SegmentShape {
    const BlobData& blob;
    WholeSegment& segment;  ///< is cut off behind the first hit
    bool any_will_do;
    std::uint32_t end = 0;  ///< where it is cut off, in 2^-31 of its length

    template <class Node>
    unsigned cull(const Node& node, float, float* keys) const {
        unsigned mask = children_within(node, blob.bits, segment.bounds);
        if (mask != 0) mask = children_on_line(segment, node, blob.bits, mask);
        const int axis = segment.longest;
        for (unsigned left = mask; left != 0; left &= left - 1) {
            const auto child = static_cast<unsigned>(std::countr_zero(left));
            const std::int32_t steps = segment.direction[axis] < 0
                                           ? segment.origin[axis] - node.high(axis, child, blob.bits)
                                           : node.low(axis, child, blob.bits) - segment.origin[axis];
            keys[child] = segment.key_of(steps > 0 ? static_cast<std::uint32_t>(steps) : 0);
        }
        return mask;
    }

    template <class Leaf>
    Visit scan(const Leaf& leaf, Closest<FoundCrossing>& answer) {
        std::uint16_t beyond[Leaf::max_vertices];
        find_places(leaf, beyond);
        auto corners = scalar::corners_of(leaf);
        const auto used = leaf.used_slots();
        for (unsigned slot = 0; slot < leaf.slot_count; ++slot) {
            const scalar::CornerNumbers vertices = corners.next();
            if ((used >> slot & 1u) == 0 || (beyond[vertices.a] & beyond[vertices.b] & beyond[vertices.c]) != 0)
                continue;
            FoundCrossing found;
            if (!crosses(segment, leaf.triangle(slot), found.crossing)) continue;
            found.index = scalar::owner_index(leaf, slot);
            answer.take(found);
            if (any_will_do) return Visit::stop;
            if (answer.last != found.index) continue;
            end = fixed_point(found.crossing);
            segment.end_at(end);
            answer.limit = segment.limit();
        }
        return Visit::next;
    }

private:
    /// For each vertex a bit for each side of the bounds that it is beyond of, and for each side of the line, seen
    /// along two axes: a triangle all of whose corners are beyond the same one is not hit.
    template <class Leaf>
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
};

/// Writes the first hit over a miss.
void find_hit(const BlobData& blob, WholeSegment& segment, bool any_will_do, LatticeHit& hit) {
    SegmentShape shape = {blob, segment, any_will_do};
    FoundCrossing first;
    Closest<FoundCrossing> answer(first);
    answer.limit = segment.limit();
    scalar::find_nearest_first(blob, shape, answer);
    if (!answer.found()) return;
    hit = {shape.end, TriangleId{first.index}, QueryStatus::ok, first.crossing.front ? Side::front : Side::back};
}

LatticeHit find_hit(const Blob& blob, const LatticeSegment& from_caller, bool any_will_do) {
    LatticeHit hit;
    hit.status = nothing_in(data_of(blob));
    if (hit.status == QueryStatus::not_open) return hit;
    WholeSegment segment;
    const QueryStatus status = segment.set(data_of(blob), from_caller);
    if (status != QueryStatus::ok) hit.status = status;
    else if (blob.triangle_count() != 0) find_hit(data_of(blob), segment, any_will_do, hit);
    return hit;
}

}  // namespace

LatticeHit detail::raycast_lattice(const Blob& blob, const LatticeSegment& segment) noexcept {
    return find_hit(blob, segment, false);
}

YesNo detail::occluded_lattice(const Blob& blob, const LatticeSegment& segment) noexcept {
    return YesNo(find_hit(blob, segment, true).status);
}

}  // namespace espalier
