#include "kinds.hpp"

#include <memory>
#include <vector>

#include "../deformation/processor_time.hpp"
#include "pair_walk.hpp"

namespace espalier::bench {
namespace {

/// Returns a kind whose boxes `boxes_of` takes from the trees of a mesh.
template <class Pose, class Stored>
TreeKind kind_of(const char* topology, const char* boxes, BoxTree<Stored> (*boxes_of)(const MeshTrees&)) {
    return {topology, boxes, sizeof(VolumeNode<Stored>),
            [boxes_of](const MeshTrees& a, const MeshTrees& b, PairQuestion question) {
                auto walk = std::make_shared<BoxPairWalk<Pose, Stored>>(boxes_of(a), boxes_of(b));
                return [walk, question](const Transform& pose) { return walk->run(question, Placement(pose)); };
            }};
}

BoxTree<StoredObb> obbs_by_obbs(const MeshTrees& trees) { return {&trees.by_obbs.tree, &trees.by_obbs.boxes}; }
BoxTree<StoredAabb> aabbs_by_obbs(const MeshTrees& trees) { return {&trees.by_obbs.tree, &trees.by_obbs_aabbs}; }
BoxTree<StoredObb> obbs_by_sah(const MeshTrees& trees) { return {trees.sah, &trees.sah_obbs}; }
BoxTree<StoredAabb> aabbs_by_sah(const MeshTrees& trees) { return {trees.sah, &trees.sah_aabbs}; }

}  // namespace

MeshTrees::MeshTrees(const AabbTree& of, BuildSeconds& seconds) : sah(&of) {
    const ProcessorTime time;
    by_obbs = build_obb_tree(of.triangles);
    seconds.obb_tree = time.seconds();
    sah_obbs = fit_obbs(of);
    seconds.fit = time.seconds() - seconds.obb_tree;
    sah_aabbs = copy_aabbs(of);
    by_obbs_aabbs = copy_aabbs(by_obbs.tree);
}

std::span<const TreeKind> all_tree_kinds() {
    static const std::vector<TreeKind> kinds = {
        kind_of<PreparedPose<StoredObb>>("obb", "obb", obbs_by_obbs),
        kind_of<PreparedPose<StoredAabb>>("obb", "aabb turned", aabbs_by_obbs),
        kind_of<ReboxingPose>("obb", "aabb reboxed", aabbs_by_obbs),
        kind_of<PreparedPose<StoredObb>>("sah", "obb", obbs_by_sah),
        kind_of<PreparedPose<StoredAabb>>("sah", "aabb turned", aabbs_by_sah),
        kind_of<ReboxingPose>("sah", "aabb reboxed", aabbs_by_sah),
    };
    return kinds;
}

}  // namespace espalier::bench
