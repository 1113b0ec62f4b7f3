// The slab test of an instruction set, for both kinds of nodes: for for_each_set.hpp, once for each set.
#include <runtime/lanes/set.hpp>
#include <runtime/rays/slab_test.hpp>
#include <runtime/rays/prepare_ray.hpp>

ESPALIER_BEGIN_SET

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

ESPALIER_END_SET
