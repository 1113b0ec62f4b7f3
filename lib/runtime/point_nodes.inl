// Distances from a point to the boxes of a node, in lanes. Included once per instruction set that has a way of its own,
// inside its namespace.

/// The children whose box is within the limit, and the squared distance of each. Planes are exact; the difference to
/// the point, which may be far away, rounds once.
inline unsigned distance_test(const Node& node, const LatticePoint& point, const BlobData& blob, float limit,
                              float* distances) {
    const Frame frame = load_frame(node, blob);
    unsigned mask = 0;
    for (unsigned first = 0; first < format::max_children; first += lanes) {
        Floats low[3], high[3];
        for (int k = 0; k < 3; ++k) {
            const auto from_point = [&](const std::byte* planes) {
                const Floats plane = multiply_add(bytes_to_floats(planes + first), frame.scale[k], frame.base[k]);
                return subtract(plane, splat(point.steps[k]));
            };
            low[k] = from_point(node.low_planes(k));
            high[k] = from_point(node.high_planes(k));
        }
        const Floats distance = squared_distance(low, high);
        mask |= at_most(distance, splat(limit)) << first;
        store(distances + first, distance);
    }
    return mask & ((1u << (node.node_children() + node.leaf_children())) - 1u);
}
