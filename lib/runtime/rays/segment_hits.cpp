// Segments in lattice steps: the nearest-first walk that rays take, with distances in steps for keys. Widths and what
// the walk may leave out: docs/numerics.md.
#include <bit>

#include <espalier/advanced/lattice.hpp>
#include <runtime/kernels/ray_triangle.hpp>
#include <runtime/rays/queries.hpp>
#include <runtime/rays/whole_segment.hpp>
#include <runtime/traversal/find.hpp>

namespace espalier::detail {

namespace {

std::uint32_t magnitude(std::int32_t a) {
    const auto bits = static_cast<std::uint32_t>(a);  // -2^31 has no positive counterpart
    return a < 0 ? 0u - bits : bits;
}

int width_of(std::uint32_t a) { return 32 - std::countl_zero(a); }

/// a * 2^shift for either sign of the shift, rounded down.
std::int32_t shifted(std::int32_t a, int shift) {
    return shift < 0 ? a >> -shift : static_cast<std::int32_t>(static_cast<std::uint32_t>(a) << shift);
}

/// Products of the narrow case fit int64, of any other one 128 bits.
template <class Number>
bool crosses_in(const WholeSegment& segment, const OriginRelative& t, Crossing& crossing) {
    return ray_triangle::decide<Number, Number>(
        segment, t, [&](bool front, const Integer3&, Number volume, Number numerator, const auto&...) {
            if (volume < numerator) return false;
            crossing = {numerator, volume, front};
            return true;
        });
}
ESPALIER_NOINLINE bool crosses_widely(const WholeSegment& segment, const OriginRelative& t, Crossing& crossing) {
    return crosses_in<Int128>(segment, t, crossing);
}

}  // namespace

QueryStatus WholeSegment::set(const BlobData& blob, const LatticeSegment& from_caller) {
    const LatticePoint& from = from_caller.from;
    const LatticePoint& to = from_caller.to;
    const std::int32_t start[3] = {from.x, from.y, from.z};
    const std::int32_t end[3] = {to.x, to.y, to.z};
    std::uint32_t any = 0;
    longest = 0;
    for (int k = 0; k < 3; ++k) {
        constexpr std::uint32_t farthest = max_lattice_coordinate;
        if (magnitude(start[k]) > farthest || magnitude(end[k]) > farthest) return QueryStatus::out_of_range;
        origin[k] = start[k];
        direction[k] = end[k] - start[k];
        if (magnitude(direction[k]) > magnitude(direction[longest])) longest = static_cast<std::uint8_t>(k);
        any |= magnitude(direction[k]) | magnitude(origin[k]) | magnitude(blob.extent[k] - origin[k]);
        const bool is_down = direction[k] < 0;
        bounds.low[k] = clamp_to_bounds(is_down ? end[k] : start[k]);
        bounds.high[k] = clamp_to_bounds(is_down ? start[k] : end[k]);
    }
    is_narrow = any <= 1u << 24;
    steps_left = magnitude(direction[longest]);
    key_shift = static_cast<std::uint8_t>(width_of(steps_left) < 30 ? 30 - width_of(steps_left) : 0);
    return steps_left != 0 ? QueryStatus::ok : QueryStatus::invalid_argument;
}

void WholeSegment::end_at(std::uint32_t t) {
    if (t == 1u << 31) return;
    for (int k = 0; k < 3; ++k) {
        const bool is_down = direction[k] < 0;
        const std::uint64_t way = std::uint64_t{magnitude(direction[k])} * (t + 1);
        const auto steps = static_cast<std::int32_t>(way >> 31);  // boxes and corners are whole
        if (is_down) bounds.low[k] = clamp_to_bounds(origin[k] - steps);
        else bounds.high[k] = clamp_to_bounds(origin[k] + steps);
        if (k == longest) steps_left = static_cast<std::uint32_t>(steps);
    }
}

LineSide::LineSide(const WholeSegment& segment, int turn, const LineGrid& grid) {
    const int m = segment.longest;
    axis = m + turn >= 3 ? m + turn - 3 : m + turn;
    const bool is_down = segment.direction[m] < 0;
    const std::uint32_t length = magnitude(segment.direction[m]);
    const std::int32_t slope = is_down ? -segment.direction[axis] : segment.direction[axis];
    const int width = width_of(length) + grid.shift[axis], width_m = width_of(magnitude(slope)) + grid.shift[m];
    const int dropped = (width > width_m ? width : width_m) - (29 - grid.bits);
    const int drop = dropped > 0 ? dropped : 0;
    across_ = shifted(static_cast<std::int32_t>(length), grid.shift[axis] - drop);
    along_ = shifted(slope, grid.shift[m] - drop);
    slack_ = 1 << grid.bits;
    constexpr std::int64_t far_beside = 1 << 30;
    const std::int64_t base = (std::int64_t{length} * (grid.base[axis] - segment.origin[axis]) -
                               std::int64_t{slope} * (grid.base[m] - segment.origin[m])) >>
                              drop;
    base_ = static_cast<std::int32_t>(base > far_beside ? far_beside : base < -far_beside ? -far_beside : base);
}

namespace {

/// `load_plane(axis, is_high, child)` returns a plane, on the grid.
template <class LoadPlane>
unsigned children_on_line_in(const WholeSegment& segment, const LineGrid& grid, unsigned mask, LoadPlane load_plane) {
    const int m = segment.longest;
    for (int turn = 1; turn <= 2; ++turn) {
        const LineSide side(segment, turn, grid);
        for (unsigned left = mask; left != 0; left &= left - 1) {
            const auto child = static_cast<unsigned>(std::countr_zero(left));
            // The corners of the rectangle that lie farthest above and below of the line.
            const std::int32_t above =
                side.place(load_plane(side.axis, true, child), load_plane(m, !side.rises(), child));
            const std::int32_t below =
                side.place(load_plane(side.axis, false, child), load_plane(m, side.rises(), child));
            if (side.is_below(above) || side.is_above(below)) mask &= ~(1u << child);
        }
    }
    return mask;
}

}  // namespace

unsigned children_on_line(const WholeSegment& segment, const PackedNode& node, unsigned bits, unsigned mask) {
    LineGrid grid;
    grid.bits = 8;
    for (int k = 0; k < 3; ++k) {
        grid.base[k] = node.base(k, bits);
        grid.shift[k] = static_cast<int>(node.shift(k));
    }
    return children_on_line_in(segment, grid, mask, [&](int axis, bool is_high, unsigned child) {
        return static_cast<std::int32_t>(load_u8((is_high ? node.high_planes(axis) : node.low_planes(axis)) + child));
    });
}

unsigned children_on_line(const WholeSegment& segment, const PlainNode& node, unsigned bits, unsigned mask) {
    LineGrid grid;
    grid.bits = 17;
    const unsigned unit = format::unit_shift(bits);
    for (int k = 0; k < 3; ++k) {
        grid.base[k] = 0;
        grid.shift[k] = static_cast<int>(unit);
    }
    // A high plane stands for all coordinates up to the next one's.
    const std::int32_t more = unit == 0 ? 0 : 1;
    return children_on_line_in(segment, grid, mask, [&](int axis, bool is_high, unsigned child) {
        const std::byte* const planes = is_high ? node.high_planes(axis) : node.low_planes(axis);
        return static_cast<std::int32_t>(load_u16(planes + 2 * std::size_t{child})) + (is_high ? more : 0);
    });
}

bool crosses(const WholeSegment& segment, const LatticeTriangle& triangle, Crossing& crossing) {
    const OriginRelative t = relative_to(segment, triangle);
    if (segment.is_narrow && ray_triangle::edges_are_below<ray_triangle::narrow_bits>(t))
        return crosses_in<std::int64_t>(segment, t, crossing);
    return crosses_widely(segment, t, crossing);
}

std::uint32_t fixed_point(const Crossing& crossing) {
    Int128 rest = crossing.numerator;
    std::uint32_t quotient = rest < crossing.denominator ? 0 : 1;
    if (quotient != 0) rest -= crossing.denominator;
    for (int bit = 0; bit < 31; ++bit) {
        rest += rest;
        quotient <<= 1;
        if (rest < crossing.denominator) continue;
        rest -= crossing.denominator;
        quotient |= 1;
    }
    return quotient;
}

bool is_before(const Crossing& a, const Crossing& b) {
    return compare_scaled(Unsigned256::product(a.numerator, b.denominator),
                          Unsigned256::product(b.numerator, a.denominator), 0) < 0;
}

}  // namespace espalier::detail

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
