// Rays: which triangles of a leaf a ray may hit, in lanes. Lanes only ever reject; what they let through is decided by
// ray_triangle.hpp. Shearing the ray into an axis is from Woop, Benthin and Wald (2013); docs/numerics.md bounds the
// errors.
#ifndef ESPALIER_RAYS_LEAF_FILTER_HPP
#define ESPALIER_RAYS_LEAF_FILTER_HPP

#include <runtime/kernels/ray_triangle.hpp>
#include <runtime/lanes/set.hpp>
#include <runtime/rays/slab_test.hpp>

ESPALIER_BEGIN_SET

/// A leaf's vertices, seen along the ray, as floats; and the test of triangles, which is whether the ray passes all
/// their edges on the same side. A hit lies among the leaf's vertices, so the sheared coordinates of a triangle that is
/// hit are at most twice as large as the leaf; each is off by at most the shear error, and so each edge function by at
/// most this.
template <unsigned groups>
class FloatVertices {
public:
    template <class Leaf>
    ESPALIER_ALWAYS_INLINE FloatVertices(const Leaf& leaf, const LatticeRay& ray) {
        const float reach = 2.0f * static_cast<float>(1u << leaf.size_bits) + ray.shear_error;
        error_ = reach * (4.125f * ray.shear_error + reach * 0x1.2p-21f);
    }
    static unsigned groups_of(unsigned vertex_count) { return Table<groups>::groups_of(vertex_count); }
    ESPALIER_ALWAYS_INLINE void set(unsigned group, Floats x, Floats y) {
        xs_.set(group, x);
        ys_.set(group, y);
    }
    /// The triangles, a lane each, that are not clearly excluded.
    ESPALIER_ALWAYS_INLINE unsigned allow(const CornerNumbers& corners) const {
        const Floats ax = xs_.look_up(corners.a), ay = ys_.look_up(corners.a);
        const Floats bx = xs_.look_up(corners.b), by = ys_.look_up(corners.b);
        const Floats cx = xs_.look_up(corners.c), cy = ys_.look_up(corners.c);
        const Floats u = multiply_subtract(bx, cy, multiply(by, cx));
        const Floats v = multiply_subtract(cx, ay, multiply(cy, ax));
        const Floats w = multiply_subtract(ax, by, multiply(ay, bx));
        return at_most(splat(-error_), smaller(u, smaller(v, w))) | at_most(larger(u, larger(v, w)), splat(error_));
    }

private:
    Table<groups> xs_, ys_;
    float error_;
};

/// The vertices for instruction sets that keep them on the stack: as pairs of 16-bit integers, which take half the
/// room. `scale_` maps twice the leaf's size to 2^14; what is larger belongs to triangles that are not hit, and may
/// wrap. Edge functions of these integers are exact. Their coarseness is charged to each triangle by its own size: the
/// nearer its corners, the less their errors move its edges.
template <unsigned groups>
class PairVertices {
public:
    template <class Leaf>
    ESPALIER_ALWAYS_INLINE PairVertices(const Leaf& leaf, const LatticeRay& ray) {
        // 2^(13 - w) for a size of 2^w.
        const std::uint32_t size = std::bit_cast<std::uint32_t>(static_cast<float>(1u << leaf.size_bits));
        scale_ = std::bit_cast<float>(((2u * 127u + 13u) << 23) - size);
        const float error = ray.shear_error * scale_ + 0.5f;
        // Larger ones could make the integers overflow, and nothing is rejected.
        const bool is_small = error < 512.0f;
        weight_ = is_small ? static_cast<std::int32_t>(error * 34.0f) + 1 : 0;
        always_allowed_ = is_small ? static_cast<std::int32_t>(error * error * 2.125f) + 2 : INT32_MAX;
    }
    static unsigned groups_of(unsigned vertex_count) { return (vertex_count + lanes - 1) / lanes; }
    /// A template, as not every instruction set has the operations on pairs.
    template <class Coordinates>
    ESPALIER_ALWAYS_INLINE void set(unsigned group, Coordinates x, Coordinates y) {
        const Floats scale = splat(scale_), rounder = splat(0x1.8p23f);  // the integers are in the low bits then
        vertices_.set(group, pair_of(multiply_add(x, scale, rounder), multiply_add(y, scale, rounder)));
    }
    ESPALIER_ALWAYS_INLINE unsigned allow(const CornerNumbers& corners) const {
        const auto a = vertices_.look_up(corners.a), b = vertices_.look_up(corners.b), c = vertices_.look_up(corners.c);
        const SignedInts u = cross_pairs(b, c), v = cross_pairs(c, a), w = negate(cross_pairs(b, a));
        const SignedInts least = smaller(u, smaller(v, w)), most = larger(u, larger(v, w));
        if constexpr (lanes == 1) {  // nearly always clear without looking at the triangle's own size
            // mutant(>> -> one less) work: fewer triangles are clear without their own size, which decides then
            const SignedInts largest = splat_integer((0xFFFF * weight_ >> 5) + always_allowed_);
            // mutant(never) work: each triangle's own size decides, which allows no more
            if ((at_most(negate(largest), least) | at_most(most, largest)) == 0) return 0;
        }
        const SignedInts above =
            add(shift_right<5>(weigh_magnitudes(a, b, c, weight_)), splat_integer(always_allowed_));
        return at_most(negate(above), least) | at_most(most, above);
    }

private:
    PairTable<groups> vertices_;
    float scale_;
    std::int32_t weight_;  ///< 32 times the error of each coordinate
    std::int32_t always_allowed_;
};

/// Floats for few vertices, and where registers hold all of a leaf.
template <unsigned groups>
using SeenVertices = std::conditional_t<(groups * lanes<32 || lanes> 8), FloatVertices<groups>, PairVertices<groups>>;

/// A leaf whose vertices are unpacked where they are needed: without wide registers unpacking all for the kernel costs
/// more than it saves.
template <class Leaf>
struct PackedLeaf : KeptLeaf<Leaf> {
    PackedLeaf() {}  // NOLINT(modernize-use-equals-default): no member has a value yet

    ESPALIER_ALWAYS_INLINE void unpack_vertices(unsigned) const {}
    /// What is looked up for the width stays out of the registers.
    [[nodiscard]] ESPALIER_ALWAYS_INLINE Ints vertices(unsigned axis, unsigned group) const {
        return offsets_of(static_cast<const Leaf&>(*this), axis, group,
                          [](unsigned own_width) { return as_if_changed(own_width); });
    }
    [[nodiscard]] ESPALIER_ALWAYS_INLINE auto corners_in_lanes() const { return corners_of(*this); }
};

/// A leaf whose vertices are unpacked once and then looked up by the exact kernel. So are the entries of a strip, where
/// lanes decode all of them.
template <class Leaf>
class UnpackedLeaf : public Leaf {
public:
    UnpackedLeaf() {}  // NOLINT(modernize-use-equals-default): no member has a value yet

    ESPALIER_ALWAYS_INLINE void unpack_vertices(unsigned groups) {
        if (has_vertices()) return;
        for (unsigned k = 0; k < 3; ++k)
            // mutant(< -> <=) equivalent: with one lane or four it fills room that is replaced or not read, from bytes
            // that are there
            for (unsigned group = 0; group < groups; ++group)
                store(steps_[k] + group * lanes, offsets_of(static_cast<const Leaf&>(*this), k, group));
    }
    /// In lattice steps from the anchor.
    [[nodiscard]] ESPALIER_ALWAYS_INLINE Ints vertices(unsigned axis, unsigned group) const {
        return load_ints(steps_[axis] + group * lanes);
    }
    [[nodiscard]] ESPALIER_ALWAYS_INLINE auto corners_in_lanes() {
        auto corners = corners_of(*this);
        if constexpr (keeps_entries) corners.keep_entries(entries_);
        return corners;
    }
    /// After both of the above; corners_in_lanes has returned the triangle in this slot.
    [[nodiscard]] LatticeTriangle triangle(unsigned slot) const {
        const LeafCorners numbers = corners(slot);
        LatticeTriangle triangle;
        for (int k = 0; k < 3; ++k) {
            const std::int32_t from = this->anchor(k);
            for (int corner = 0; corner < 3; ++corner)
                triangle.corner[corner][k] = from + static_cast<std::int32_t>(steps_[k][numbers.vertex[corner]]);
        }
        return triangle;
    }

    /// Those of a predicted strip are unpacked with the leaf.
    [[nodiscard]] ESPALIER_ALWAYS_INLINE bool has_vertices() const {
#if ESPALIER_PREDICTED_STRIPS
        if constexpr (std::is_same_v<Leaf, StripLeaf>) return this->is_predicted();
#endif
        return false;
    }
    [[nodiscard]] std::uint32_t* steps(unsigned axis) { return steps_[axis]; }

private:
    static constexpr bool keeps_entries =
        requires(decltype(corners_of(std::declval<const Leaf&>())) corners, std::uint8_t* to) {
        corners.keep_entries(to);
    };
    static constexpr unsigned room = (Leaf::max_vertices + lanes - 1) / lanes * lanes;

    [[nodiscard]] LeafCorners corners(unsigned slot) const {
        if constexpr (keeps_entries) {
            const auto places = this->window(slot);
            return {entries_[places[0]], entries_[places[1]], entries_[places[2]]};
        } else {
            return Leaf::corners(slot);
        }
    }

    alignas(sizeof(Ints)) std::uint32_t steps_[3][room];
    std::uint8_t entries_[keeps_entries ? format::max_leaf_entries : 1];
};

#if ESPALIER_PREDICTED_STRIPS
/// Apart from what decodes other strips.
ESPALIER_NOINLINE inline void unpack_predicted_strip(const BlobData& blob, PackedNode node, unsigned number,
                                                     UnpackedLeaf<StripLeaf>& leaf) {
    decode_predicted_marks(blob, node, number, leaf);
    decode_points(leaf, leaf.steps(0), leaf.steps(1), leaf.steps(2));
}
/// Unpacks the vertices too, of a predicted strip.
ESPALIER_ALWAYS_INLINE inline void decode_leaf(const BlobData& blob, PackedNode node, unsigned number,
                                               UnpackedLeaf<StripLeaf>& leaf) {
    if (has_predicted_leaves(blob.profile)) return unpack_predicted_strip(blob, node, number, leaf);
    decode_leaf(blob, node, number, static_cast<StripLeaf&>(leaf));
}
#endif

template <class Leaf>
using RayLeaf = std::conditional_t<keeps_unpacked, UnpackedLeaf<Leaf>, PackedLeaf<Leaf>>;

/// What a leaf's coordinates count from on an axis, seen from the ray's origin, given lattice point 0 0 0 from there:
/// exactly, as it is a lattice point of the asset.
template <class Leaf>
ESPALIER_ALWAYS_INLINE inline float anchor_from_origin(const Leaf& leaf, const float* zero, unsigned axis) {
    if constexpr (Leaf::counts_from_zero) return zero[axis];
    else return static_cast<float>(leaf.anchor(static_cast<int>(axis))) + zero[axis];
}

/// Places the vertices of a leaf, unpacked, as the ray sees them.
template <unsigned groups, class SomeLeaf>
ESPALIER_ALWAYS_INLINE inline void see_vertices(const SomeLeaf& leaf, const LatticeRay& ray, unsigned used,
                                                SeenVertices<groups>& vertices) {
    const unsigned kx = ray.axis[0], ky = ray.axis[1], kz = ray.axis[2];
    const Floats offset_x = splat(anchor_from_origin(leaf, ray.zero, kx));
    const Floats offset_y = splat(anchor_from_origin(leaf, ray.zero, ky));
    const Floats offset_z = splat(anchor_from_origin(leaf, ray.zero, kz));
    const Floats shear_x = splat(ray.shear[0]), shear_y = splat(ray.shear[1]);
    for (unsigned group = 0; group < used; ++group) {
        const auto coordinate = [&](unsigned k, Floats from) { return add(to_floats(leaf.vertices(k, group)), from); };
        const Floats z = coordinate(kz, offset_z);
        vertices.set(group, multiply_add(z, shear_x, coordinate(kx, offset_x)),
                     multiply_add(z, shear_y, coordinate(ky, offset_y)));
    }
}

/// Decodes a leaf and returns the triangles that the ray may hit: those whose edges, seen along the ray, do not clearly
/// exclude it. Out of line, so that the traversal keeps its registers; in place, because a copy would be read in wider
/// pieces than it was written in and stall store forwarding.
template <class SomeLeaf>
ESPALIER_NOINLINE inline typename SomeLeaf::Slots ray_candidates(const BlobData& blob, typename SomeLeaf::Node node,
                                                                 unsigned number, const LatticeRay& ray,
                                                                 SomeLeaf& leaf) {
    decode_leaf(blob, node, number, leaf);
    return with_table_groups<SomeLeaf::max_vertices>(leaf.vertex_count, [&](auto groups) ESPALIER_ALWAYS_INLINE_LAMBDA {
        const unsigned used = SeenVertices<groups>::groups_of(leaf.vertex_count);
        leaf.unpack_vertices(used);
        SeenVertices<groups> vertices(leaf, ray);
        see_vertices<groups>(leaf, ray, used, vertices);
        typename SomeLeaf::Slots mask = 0;
        auto corners = leaf.corners_in_lanes();
        // mutant(< -> <=) sanitizer: looks up vertices behind the end of a table, for slots that are not used
        for (unsigned first = 0; first < leaf.slot_count; first += lanes) {
            const typename SomeLeaf::Slots hit = vertices.allow(corners.next());
            mask |= hit << first;
        }
        return mask & leaf.used_slots();
    });
}

/// Whether the ray hits the triangle in a slot, which lanes did not reject; with a TriangleHit to fill, in its window,
/// else at any tau from 0 on. Out of line, and the wide kernels are separate tail calls, so their frames never coexist.
template <class Leaf, class... Hit>
ESPALIER_NOINLINE inline bool hits_slot_of_huge_leaf(const Leaf& leaf, unsigned slot, const LatticeRay& ray,
                                                     Hit&... hit) {
    return ray_triangle::hits<Int128, Int128>(ray, relative_to(ray, leaf.triangle(slot)), hit...);
}
template <class Leaf, class... Hit>
ESPALIER_NOINLINE inline bool hits_slot_of_large_leaf(const Leaf& leaf, unsigned slot, const LatticeRay& ray,
                                                      Hit&... hit) {
    using namespace ray_triangle;
    // mutant(> -> >=) work: wider numbers give the same answer
    if (leaf.size_bits > middle_bits) return hits_slot_of_huge_leaf(leaf, slot, ray, hit...);
    const OriginRelative t = relative_to(ray, leaf.triangle(slot));
    // mutant(never) work: wider numbers give the same answer
    if (edges_are_below<narrow_bits>(t)) return hits<std::int64_t, std::int64_t>(ray, t, hit...);
    return hits<std::int64_t, Int128>(ray, t, hit...);
}
template <class Leaf, class... Hit>
ESPALIER_NOINLINE inline bool hits_slot(const Leaf& leaf, unsigned slot, const LatticeRay& ray, Hit&... hit) {
    using namespace ray_triangle;
    count_decision();
    if constexpr (has_native_int128) {
        // mutant(> -> >=) work: looks at the edges, which are short, and takes the same kernel
        if (leaf.size_bits > narrow_bits) return hits_slot_of_large_leaf(leaf, slot, ray, hit...);
        return hits<std::int64_t, std::int64_t>(ray, relative_to(ray, leaf.triangle(slot)), hit...);
    } else if constexpr (sizeof...(hit) != 0) {
        return intersect(ray, leaf.triangle(slot), hit...);  // one kernel for leaves of all sizes
    } else {
        TriangleHit unused;
        return intersect(ray, leaf.triangle(slot), unused);
    }
}
/// Whether it takes less to decide that a ray without a window hits a triangle.
inline constexpr bool decides_by_signs = true;
/// Whether the ray hits the triangle in a slot in its window.
template <class Leaf>
inline bool is_hit(const Leaf& leaf, unsigned slot, const LatticeRay& ray) {
    // By the bits: both are 0 or more.
    // mutant(never) work: compares tau with a window that excludes nothing
    if (std::bit_cast<std::uint32_t>(ray.tau_min) == 0 && std::bit_cast<std::uint32_t>(ray.tau_max) == infinity_bits)
        return hits_slot(leaf, slot, ray);
    TriangleHit hit;
    return hits_slot(leaf, slot, ray, hit);
}

ESPALIER_END_SET

#endif
