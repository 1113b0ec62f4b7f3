// How nodes and rays become lanes, for the x86 instruction sets: the constants of all three axes are made in one
// register, then spread. Included inside their namespaces, which offer `multiply_add`, `spread` and `shift_left_each`
// beforehand.

/// The shifts of all three axes, each in the place of a float's exponent.
inline __m128i load_shifts(const PackedNode& node) {
    // They lie in the low half of this word, 5 bits each.
    return _mm_and_si128(shift_left_each<23, 18, 13>(node.bytes + format::packed_node::shifts_at),
                         _mm_set1_epi32(31 << 23));
}
inline __m128 load_scales(const PackedNode& node) {
    return _mm_castsi128_ps(_mm_add_epi32(load_shifts(node), _mm_set1_epi32(127 << 23)));
}
/// In the units that bases count in.
inline __m128 load_bases(const PackedNode& node) {
    return _mm_cvtepi32_ps(_mm_cvtepu16_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(node.bytes))));
}

/// The low corner of a child's box, seen from a ray's origin.
struct Corner {
    alignas(16) float at[4];
};
inline __m128 load_origin_steps(const LatticeRay& ray) {
    const __m128 origin = _mm_cvtepi32_ps(_mm_load_si128(reinterpret_cast<const __m128i*>(ray.origin)));
    return _mm_mul_ps(origin, _mm_set1_ps(power_of_two(-ray.fraction_bits)));
}
[[gnu::always_inline]] inline Corner load_low_corner(const PackedNode& node, unsigned child, const BlobData& blob,
                                                     const LatticeRay& ray) {
    const std::uint32_t bytes = load_u8(node.low_planes(0) + child) | load_u8(node.low_planes(1) + child) << 8 |
                                load_u8(node.low_planes(2) + child) << 16;
    const __m128 planes = _mm_cvtepi32_ps(_mm_cvtepu8_epi32(_mm_cvtsi32_si128(static_cast<int>(bytes))));
    const __m128 bases = _mm_mul_ps(load_bases(node), _mm_set1_ps(blob.base_unit));
    Corner corner;
    // The corner of a leaf's box is a lattice point of the asset, and `open` proved it: each difference here is exact.
    _mm_store_ps(corner.at, multiply_add(planes, load_scales(node), _mm_sub_ps(bases, load_origin_steps(ray))));
    return corner;
}

/// A node's frame: plane * scale + base is a lattice coordinate, exactly.
struct Frame {
    Floats scale[3];
    Floats base[3];
};
inline Frame load_frame(const PackedNode& node, const BlobData& blob) {
    Frame frame;
    spread(load_scales(node), frame.scale);
    spread(_mm_mul_ps(load_bases(node), _mm_set1_ps(blob.base_unit)), frame.base);
    return frame;
}
