// Rays: which triangles of a leaf a ray may hit, in lanes. Lanes only ever reject; what they let through is decided by
// ray_triangle.hpp. Shearing the ray into an axis is from Woop, Benthin and Wald (2013); docs/numerics.md bounds the
// errors.
#ifndef ESPALIER_IN_INSTRUCTION_SET  // parsed alone
#include <runtime/rays/pair_vertices.inl>
#endif

/// A leaf whose vertices are unpacked where they are needed: without wide registers unpacking all for the kernel costs
/// more than it saves.
template <class Leaf>
struct PackedLeaf : KeptLeaf<Leaf> {
    PackedLeaf() {}  // NOLINT(modernize-use-equals-default): no member has a value yet

    [[gnu::always_inline]] void unpack_vertices(unsigned) const {}
    /// What is looked up for the width stays out of the registers.
    [[nodiscard, gnu::always_inline]] Ints vertices(unsigned axis, unsigned group) const {
        return offsets_of(static_cast<const Leaf&>(*this), axis, group,
                          [](unsigned own_width) { return as_if_changed(own_width); });
    }
    [[nodiscard, gnu::always_inline]] auto corners_in_lanes() const { return corners_of(*this); }
};

/// A leaf whose vertices are unpacked once and then looked up by the exact kernel. So are the entries of a strip, where
/// lanes decode all of them.
template <class Leaf>
class UnpackedLeaf : public Leaf {
public:
    UnpackedLeaf() {}  // NOLINT(modernize-use-equals-default): no member has a value yet

    [[gnu::always_inline]] void unpack_vertices(unsigned groups) {
        if (has_vertices()) return;
        for (unsigned k = 0; k < 3; ++k)
            for (unsigned group = 0; group < groups; ++group)
                store(steps_[k] + group * lanes, offsets_of(static_cast<const Leaf&>(*this), k, group));
    }
    /// In lattice steps from the anchor.
    [[nodiscard, gnu::always_inline]] Ints vertices(unsigned axis, unsigned group) const {
        return load_ints(steps_[axis] + group * lanes);
    }
    [[nodiscard, gnu::always_inline]] auto corners_in_lanes() {
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
    [[nodiscard, gnu::always_inline]] bool has_vertices() const {
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
[[gnu::noinline]] inline void unpack_predicted_strip(const BlobData& blob, PackedNode node, unsigned number,
                                                     UnpackedLeaf<StripLeaf>& leaf) {
    decode_predicted_marks(blob, node, number, leaf);
    decode_points(leaf, leaf.steps(0), leaf.steps(1), leaf.steps(2));
}
/// Unpacks the vertices too, of a predicted strip.
[[gnu::always_inline]] inline void decode_leaf(const BlobData& blob, PackedNode node, unsigned number,
                                               UnpackedLeaf<StripLeaf>& leaf) {
    if (has_predicted_leaves(blob.profile)) return unpack_predicted_strip(blob, node, number, leaf);
    decode_leaf(blob, node, number, static_cast<StripLeaf&>(leaf));
}
#endif

template <class Leaf>
using RayLeaf = std::conditional_t<keeps_unpacked, UnpackedLeaf<Leaf>, PackedLeaf<Leaf>>;

/// What a leaf's coordinates count from, seen from the ray's origin.
struct ZeroCorner {
    const float* at;
};
template <class Leaf>
[[gnu::always_inline]] inline auto corner_from_origin(const Leaf& leaf, const LatticeRay& ray) {
    if constexpr (Leaf::counts_from_zero) return ZeroCorner{ray.zero};
    else return load_low_corner(leaf.node, leaf.child(), *leaf.blob, ray);
}

/// The triangles of a leaf that the ray may hit: those whose edges, seen along the ray, do not clearly exclude it.
template <unsigned groups, class SomeLeaf>
[[gnu::always_inline]] inline typename SomeLeaf::Slots ray_candidates_of(SomeLeaf& leaf, const LatticeRay& ray) {
    const unsigned used = SeenVertices<groups>::groups_of(leaf.vertex_count);
    leaf.unpack_vertices(used);
    const unsigned kx = ray.axis[0], ky = ray.axis[1], kz = ray.axis[2];
    const auto corner = corner_from_origin(leaf, ray);
    const Floats offset_x = splat(corner.at[kx]), offset_y = splat(corner.at[ky]), offset_z = splat(corner.at[kz]);
    const Floats shear_x = splat(ray.shear[0]), shear_y = splat(ray.shear[1]);
    SeenVertices<groups> vertices(leaf, ray);
    for (unsigned group = 0; group < used; ++group) {
        const auto coordinate = [&](unsigned k, Floats from) { return add(to_floats(leaf.vertices(k, group)), from); };
        const Floats z = coordinate(kz, offset_z);
        vertices.set(group, multiply_add(z, shear_x, coordinate(kx, offset_x)),
                     multiply_add(z, shear_y, coordinate(ky, offset_y)));
    }
    typename SomeLeaf::Slots mask = 0;
    auto corners = leaf.corners_in_lanes();
    for (unsigned first = 0; first < leaf.slot_count; first += lanes) {
        const typename SomeLeaf::Slots hit = vertices.allow(corners.next());
        mask |= hit << first;
    }
    return mask & leaf.used_slots();
}

/// The same, from where the leaf is. Apart from the walk, which then keeps its own numbers in registers. Decoded in
/// place: a leaf that is copied is read in wider pieces than it was written in, and waits for them.
template <class SomeLeaf>
[[gnu::noinline]] inline typename SomeLeaf::Slots decode_candidates(const BlobData& blob, typename SomeLeaf::Node node,
                                                                    unsigned number, const LatticeRay& ray,
                                                                    SomeLeaf& leaf) {
    decode_leaf(blob, node, number, leaf);
    return with_table_groups<SomeLeaf::max_vertices>(
        leaf.vertex_count, [&](auto groups)
                               __attribute__((always_inline)) { return ray_candidates_of<groups>(leaf, ray); });
}
template <class SomeLeaf>
[[gnu::always_inline]] inline typename SomeLeaf::Slots ray_candidates(const PlaceOf<SomeLeaf>& place,
                                                                      const LatticeRay& ray, SomeLeaf& leaf) {
    return decode_candidates(*place.blob, place.node, place.number, ray, leaf);
}

/// Whether the ray hits the triangle in a slot, which lanes did not reject; with a TriangleHit to fill, in its window,
/// else at any tau from 0 on. Apart from the walk, and the kernels for long edges apart from the one for short ones,
/// which jumps to them: on the stack there is never more than one's need.
template <class Leaf, class... Hit>
[[gnu::noinline]] inline bool hits_slot_of_huge_leaf(const Leaf& leaf, unsigned slot, const LatticeRay& ray,
                                                     Hit&... hit) {
    return ray_triangle::hits<Int128, Int128>(ray, relative_to(ray, leaf.triangle(slot)), hit...);
}
template <class Leaf, class... Hit>
[[gnu::noinline]] inline bool hits_slot_of_large_leaf(const Leaf& leaf, unsigned slot, const LatticeRay& ray,
                                                      Hit&... hit) {
    using namespace ray_triangle;
    if (leaf.size_bits > middle_bits) return hits_slot_of_huge_leaf(leaf, slot, ray, hit...);
    const OriginRelative t = relative_to(ray, leaf.triangle(slot));
    if (edges_are_below<narrow_bits>(t)) return hits<std::int64_t, std::int64_t>(ray, t, hit...);
    return hits<std::int64_t, Int128>(ray, t, hit...);
}
template <class Leaf, class... Hit>
[[gnu::noinline]] inline bool hits_slot(const Leaf& leaf, unsigned slot, const LatticeRay& ray, Hit&... hit) {
    using namespace ray_triangle;
    count_decision();
    if constexpr (has_native_int128) {
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
    if (std::bit_cast<std::uint32_t>(ray.tau_min) == 0 && std::bit_cast<std::uint32_t>(ray.tau_max) == infinity_bits)
        return hits_slot(leaf, slot, ray);
    TriangleHit hit;
    return hits_slot(leaf, slot, ray, hit);
}
