// The slab test of an instruction set, for both kinds of nodes. Included once per instruction set, inside its
// namespace.

/// Prepared by the instruction set's own way, tested by its lanes.
template <class Node>
unsigned children(const BlobData& blob, const Ray& ray, const Node& node, float limit, float* keys) {
    PreparedRayIn<RayLanesOf<Node>> prepared;
    if (prepare(blob, ray, prepared) != QueryStatus::ok) return 0;
    return slab_test(node, prepared.lanes(), limit, keys);
}
/// Prepared as it is defined, tested by lanes.
template <class Node>
unsigned children_as_defined(const BlobData& blob, const Ray& ray, const Node& node, float limit, float* keys) {
    PreparedRayIn<RayLanesOf<Node>> prepared;
    return prepare_ray(blob, ray, prepared) ? slab_test(node, prepared.lanes(), limit, keys) : 0;
}
