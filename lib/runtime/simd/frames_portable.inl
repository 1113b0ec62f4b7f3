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
