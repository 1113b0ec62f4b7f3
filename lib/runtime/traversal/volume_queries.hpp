// The walk that most shapes share. Lanes reject the triangles beyond one side of the shape, and accept those
// with a corner inside of it; the kernel of the shape decides on the others.
#ifndef ESPALIER_TRAVERSAL_VOLUME_QUERIES_HPP
#define ESPALIER_TRAVERSAL_VOLUME_QUERIES_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/traversal/volume.hpp>
#include <runtime/traversal/find.hpp>

ESPALIER_BEGIN_SET

/// The bits of a vertex's word, one for each side of a shape that it may be beyond. A triangle all of whose corners are
/// beyond one side is out (Sutherland and Cohen). Shapes have either bounds and few planes, or planes only.
struct Sides {
    static constexpr unsigned bounds_shift = 26;
    static constexpr std::uint32_t planes = (1u << bounds_shift) - 1u;  ///< of a shape with bounds
    static_assert(max_planes == 32 && bounds_shift + 6 == 32);
    static constexpr unsigned below(unsigned k) { return bounds_shift + 2 * k; }
    static constexpr unsigned above(unsigned k) { return below(k) + 1; }
};

/// Returns the sides that do not have all vertices of a leaf inside of them: all sides, where vertices may lie
/// outside of the leaf's box.
template <class Leaf>
inline std::uint32_t sides_that_matter(const Leaf& leaf, const Volume& volume) {
    const unsigned bits = leaf.blob->bits;
    const bool in_box = !Leaf::may_have_duplicates || leaf.blob->copies == nullptr;
    std::uint32_t sides = 0;
    for (unsigned i = 0; i < volume.plane_count; ++i)
        if (!in_box || !is_wholly_behind(leaf.node, bits, leaf.child(), volume.planes[i])) sides |= 1u << i;
    if (!volume.bounded) return sides;
    for (unsigned i = 0; i < 3; ++i) {
        const auto k = static_cast<int>(i);
        if (!in_box || leaf.node.low(k, leaf.child(), bits) < volume.bounds.low[k]) sides |= 1u << Sides::below(i);
        if (!in_box || leaf.node.high(k, leaf.child(), bits) > volume.bounds.high[k]) sides |= 1u << Sides::above(i);
    }
    return sides;
}

/// A plane for vertices in lanes. The limits allow for what floats round (docs/numerics.md, *Volumes in lanes*).
struct PlaneInLanes {
    Floats normal[3];
    Floats beyond;  ///< a vertex that reaches farther is beyond the plane
    Floats inside;  ///< a vertex that reaches no farther is behind it

    PlaneInLanes(const LatticePlane& plane, unsigned bits) {
        float length = 0.0f;
        for (int k = 0; k < 3; ++k) {
            const auto along = static_cast<float>(plane.normal[k]);
            normal[k] = splat(along);
            length += absolute(along);
        }
        const float most = length * power_of_two(static_cast<int>(bits));
        const auto offset = static_cast<float>(plane.offset);
        const float rounding = (most + absolute(offset)) * 0x1p-21f;
        beyond = splat(offset + rounding);
        inside = splat(offset - rounding);
    }
    [[nodiscard]] Floats reach_of(const Floats* at) const {
        return multiply_add(at[0], normal[0], multiply_add(at[1], normal[1], multiply(at[2], normal[2])));
    }
};

/// Returns 1 in lanes where a number is below 0.
inline Ints sign_of(Ints a) { return a >> 31; }
inline Ints is_less(Floats a, Floats b) { return sign_of(__builtin_bit_cast(Ints, subtract(a, b))); }
/// Returns the lanes without a bit.
inline unsigned without_bits(Ints a) {
    return at_most(__builtin_bit_cast(SignedInts, a >> 1 | (a & 1)), splat_integer(0));
}

/// Returns the triangles of a leaf that a shape may overlap, and those that it surely does.
template <unsigned groups, class Leaf>
ESPALIER_NOINLINE inline OverlapCandidates<typename Leaf::Slots> candidates_of(const Leaf& leaf, const Volume& volume,
                                                                               std::uint32_t matter) {
    using Slots = typename Leaf::Slots;
    const bool has_inside = volume.is_enclosure;
    const std::uint32_t planes = volume.bounded ? matter & Sides::planes : matter;
    PairTable<groups> beyond, outside;
    for (unsigned group = 0; group < Table<groups>::groups_of(leaf.vertex_count); ++group) {
        Ints sides = __builtin_bit_cast(Ints, splat_integer(0));
        Ints at[3];
        for (unsigned k = 0; k < 3; ++k) {
            at[k] = add(offsets_of(leaf, k, group), static_cast<std::uint32_t>(leaf.anchor(static_cast<int>(k))));
            if (!volume.bounded) continue;
            const auto low = static_cast<std::uint32_t>(volume.bounds.low[k]);
            const auto high = static_cast<std::uint32_t>(volume.bounds.high[k]);
            sides = sides | sign_of(add(at[k], 0u - low)) << Sides::below(k);
            sides = sides | sign_of(~add(at[k], ~high)) << Sides::above(k);  // high less the coordinate
        }
        Ints shallow = sides;
        if (planes != 0) {
            const Floats places[3] = {to_floats(at[0]), to_floats(at[1]), to_floats(at[2])};
            for (std::uint32_t left = planes; left != 0; left &= left - 1) {
                const auto i = static_cast<unsigned>(std::countr_zero(left));
                const PlaneInLanes plane(volume.planes[i], leaf.blob->bits);
                const Floats reach = plane.reach_of(places);
                sides = sides | is_less(plane.beyond, reach) << i;
                shallow = shallow | is_less(plane.inside, reach) << i;
            }
        }
        beyond.set(group, sides);
        if (has_inside) outside.set(group, shallow);
    }
    OverlapCandidates<Slots> candidates;
    auto corners = corners_of(leaf);
    for (unsigned first = 0; first < leaf.slot_count; first += lanes) {
        const auto numbers = corners.next();
        candidates.near |=
            Slots{without_bits(beyond.look_up(numbers.a) & beyond.look_up(numbers.b) & beyond.look_up(numbers.c))}
            << first;
        if (has_inside)
            candidates.sure |=
                Slots{without_bits(outside.look_up(numbers.a)) | without_bits(outside.look_up(numbers.b)) |
                      without_bits(outside.look_up(numbers.c))}
                << first;
    }
    candidates.near &= leaf.used_slots();
    return candidates;
}

/// Tests whether all corners are beyond one of the planes.
[[maybe_unused]] inline bool is_beyond_a_plane(const Volume& volume, const LatticeTriangle& triangle) {
    for (unsigned i = 0; i < volume.plane_count; ++i) {
        const LatticePlane& plane = volume.planes[i];
        bool is_beyond = true;
        for (const auto& corner : triangle.corner) {
            std::int64_t reached = 0;
            for (int k = 0; k < 3; ++k) reached += std::int64_t{plane.normal[k]} * corner[k];
            is_beyond = is_beyond && reached > plane.offset;
        }
        if (is_beyond) return true;
    }
    return false;
}

struct VolumeShape {
    const BlobData& blob;
    const Volume& volume;

    template <class Node>
    [[nodiscard]] unsigned cull(const Node& node, float, float*) const {
        unsigned mask = volume.bounded ? children_within(node, blob.bits, volume.bounds) : all_children(node);
        for (unsigned i = 0; volume.planes_cull && i < volume.plane_count && mask != 0; ++i)
            mask = children_behind(node, blob.bits, volume.planes[i], mask);
        return mask;
    }
    /// For small code, which needs no float.
    template <class Leaf>
    [[nodiscard]] Visit decide(const Leaf& leaf, unsigned slot, const LatticeTriangle& triangle, Each& answer) const {
        if ((volume.bounded && is_beside(volume.bounds, triangle.corner)) || is_beyond_a_plane(volume, triangle))
            return Visit::next;
        count_decision();
        if (!volume.kernel(volume, triangle)) return Visit::next;
        return answer.take(found_at(leaf, storage_index(leaf, slot)), leaf, slot);
    }
    template <class Leaf>
    [[nodiscard]] Visit scan(const Leaf& leaf, Each& answer) const {
        using Slots = typename Leaf::Slots;
        const std::uint32_t matter = sides_that_matter(leaf, volume);
        OverlapCandidates<Slots> candidates = {leaf.used_slots(), ~Slots{0}};
        if (matter != 0 || !volume.is_enclosure)
            candidates = with_table_groups<Leaf::max_vertices>(
                leaf.vertex_count, [&](auto groups) { return candidates_of<groups>(leaf, volume, matter); });
        return take_candidates(leaf, candidates, answer, [&](unsigned slot) {
            count_decision();
            return volume.kernel(volume, leaf.triangle(slot));
        });
    }
};

ESPALIER_QUERY_OF_SET bool find_overlaps_of_volume(const BlobData& blob, const Volume& volume, Each& answer,
                                                   const WalkAccuracy& accuracy) {
    VolumeShape shape = {blob, volume};
    return find_each<Each>(blob, shape, answer, accuracy);
}

ESPALIER_END_SET

#endif
