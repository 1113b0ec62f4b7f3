// A node's planes along a ray, axis by axis, for instruction sets without a better way. Included inside their
// namespaces.

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
