// Distances from a point to the boxes of a node, in lanes. Included once per instruction set that has a way of its own,
// inside its namespace.

/// The planes of a group of children, seen from the point. Planes are exact; the difference to the point, which may be
/// far away, rounds once.
inline void planes_from_point(const Node& node, const Frame& frame, const LatticePoint& point, unsigned first,
                              Floats* low, Floats* high) {
    for (int k = 0; k < 3; ++k) {
        const auto from_point = [&](const std::byte* planes) {
            const Floats plane = multiply_add(bytes_to_floats(planes + first), frame.scale[k], frame.base[k]);
            return subtract(plane, splat(point.steps[k]));
        };
        low[k] = from_point(node.low_planes(k));
        high[k] = from_point(node.high_planes(k));
    }
}

/// The children whose box is within the limit, and the squared distance of each.
inline unsigned distance_test(const Node& node, const LatticePoint& point, const BlobData& blob, float limit,
                              float* distances) {
    const Frame frame = load_frame(node, blob);
    unsigned mask = 0;
    for (unsigned first = 0; first < format::max_children; first += lanes) {
        Floats low[3], high[3];
        planes_from_point(node, frame, point, first, low, high);
        const Floats distance = squared_distance(low, high);
        mask |= at_most(distance, splat(limit)) << first;
        store(distances + first, distance);
    }
    return mask & all_children(node);
}

/// The children whose box is within the point's radius, and of these the ones that are clearly inside of it altogether.
inline unsigned overlap_test(const Node& node, const LatticePoint& point, const BlobData& blob, unsigned& inside) {
    const Frame frame = load_frame(node, blob);
    unsigned mask = 0;
    inside = 0;
    // mutant(< -> <=) equivalent: tests a ninth child from the bytes behind the node and masks it out
    for (unsigned first = 0; first < format::max_children; first += lanes) {
        Floats low[3], high[3];
        planes_from_point(node, frame, point, first, low, high);
        mask |= at_most(squared_distance(low, high), splat(point.limit)) << first;
        // mutant(|= nothing) work: tests each triangle of a box that is wholly inside, with the same result
        inside |= at_most(squared_distance_of_far_corner(low, high), splat(point.inner_limit)) << first;
    }
    return mask & all_children(node);
}
