// How nodes become lanes: the constants of all three axes are made in one register, then spread.

/// The shifts of all three axes, each in the place of a float's exponent: adding one multiplies by its power of two.
inline AxisInts load_shifts(const PackedNode& node) {
    // They lie in the low half of this word, 5 bits each.
    return shift_left_each<23, 18, 13>(node.bytes + format::packed_node::shifts_at) & (31 << 23);
}
inline Axes load_scales(const PackedNode& node) { return __builtin_bit_cast(Axes, load_shifts(node) + (127 << 23)); }
/// In the units that bases count in.
// mutant(+ -> -, + -> right side dropped) equivalent: base_at is 0
inline Axes load_bases(const PackedNode& node) { return words_to_axes(node.bytes + format::packed_node::base_at); }

/// The three axes to all lanes each.
inline void spread(Axes a, Floats* to) {
    to[0] = splat(a[0]);
    to[1] = splat(a[1]);
    to[2] = splat(a[2]);
}

inline Frame load_frame(const PackedNode& node, const BlobData& blob) {
    Frame frame;
    spread(load_scales(node), frame.scale);
    spread(load_bases(node) * blob.base_unit, frame.base);
    return frame;
}

inline SlabFrame load_slab_frame(const PackedNode& node, const RayLanes& ray) {
    const Axes steps = load_bases(node) * load_as<Axes>(ray.base_inverse);
    SlabFrame frame;
    spread(__builtin_bit_cast(Axes, load_shifts(node) + load_as<AxisInts>(ray.inverse)), frame.scale);
    spread(steps + load_as<Axes>(ray.near_offset), frame.near_offset);
    spread(steps + load_as<Axes>(ray.far_offset), frame.far_offset);
    return frame;
}
