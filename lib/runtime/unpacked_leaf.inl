// A leaf as single rays and groups of them need it: lanes filter its triangles, the exact kernel decides those that are
// left. Included once per instruction set, inside its namespace.

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
