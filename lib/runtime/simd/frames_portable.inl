// How nodes and rays become lanes, axis by axis, for instruction sets without a better way. Included inside their
// namespaces.

/// The low corner of a child's box, seen from a ray's origin.
struct Corner {
    float at[3];
};
inline Corner load_low_corner(const PackedNode& node, unsigned child, const BlobData& blob, const LatticeRay& ray) {
    Corner corner;
    // mutant(< -> <=) sanitizer: writes a fourth coordinate behind three, which is never read
    for (int k = 0; k < 3; ++k)
        corner.at[k] = static_cast<float>(node.low(k, child, blob.bits)) - origin_steps(ray, static_cast<unsigned>(k));
    return corner;
}

/// A node's frame: plane * scale + base is a lattice coordinate, exactly.
struct Frame {
    Floats scale[3];
    Floats base[3];
};
inline Frame load_frame(const PackedNode& node, const BlobData& blob) {
    Frame frame;
    for (int k = 0; k < 3; ++k) {
        frame.scale[k] = splat(power_of_two(static_cast<int>(node.shift(k))));
        frame.base[k] = splat(static_cast<float>(node.base(k, blob.bits)));
    }
    return frame;
}

/// The planes of a node as tau along a ray: plane * scale + offset.
struct SlabFrame {
    Floats scale[3];
    Floats near_offset[3];
    Floats far_offset[3];
};
inline SlabFrame load_slab_frame(const PackedNode& node, const RayLanes& ray) {
    SlabFrame frame;
    for (int k = 0; k < 3; ++k) {
        const float base = static_cast<float>(node.base(k, 0)) * ray.base_inverse[k];
        frame.scale[k] = splat(power_of_two(static_cast<int>(node.shift(k))) * ray.inverse[k]);
        frame.near_offset[k] = splat(base + ray.near_offset[k]);
        frame.far_offset[k] = splat(base + ray.far_offset[k]);
    }
    return frame;
}
