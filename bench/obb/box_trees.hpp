// Binary trees of oriented boxes and of axis-aligned ones, on one topology.
#pragma once

#include "../study/aabb_tree.hpp"
#include "../study/shapes.hpp"
#include "../study/walks.hpp"
#include "../volumes/trees.hpp"

namespace espalier::bench {

/// Nodes with a box of one kind, in the order of the tree that they belong to.
template <class Stored>
using BoxNodes = std::vector<VolumeNode<Stored>>;

/// A tree whose topology follows from oriented boxes, and these.
struct ObbTree {
    AabbTree tree;
    BoxNodes<StoredObb> boxes;
};

/// Builds from the top down (Gottschalk, Lin, Manocha 1996), one triangle in each leaf: a box is fitted by
/// BoxFit::hull, and a plane across its longest axis divides the triangles by the side of their centers; it goes
/// through the mean of the vertices. Where all are on one side, the next axis is taken, and at last a half of them.
[[nodiscard]] ObbTree build_obb_tree(std::span<const FloatTriangle> triangles);

/// Fits oriented boxes to the nodes of a tree, as build_obb_tree does.
[[nodiscard]] BoxNodes<StoredObb> fit_obbs(const AabbTree& tree);

// The kinds of tree that are compared: two topologies, and on each the boxes and their tests.

/// Processor time.
struct BuildSeconds {
    double obb_tree = 0.0;  ///< of build_obb_tree
    double fit = 0.0;       ///< of oriented boxes for a tree that is there
};

/// All trees of a mesh.
struct MeshTrees {
    /// `sah` has one triangle in each leaf and outlives this.
    MeshTrees(const AabbTree& sah, BuildSeconds& seconds);
    MeshTrees(const MeshTrees&) = delete;
    MeshTrees& operator=(const MeshTrees&) = delete;

    const AabbTree* sah;
    ObbTree by_obbs;
    BoxNodes<StoredObb> sah_obbs;
};

struct TreeKind {
    const char* topology;    ///< "obb": of build_obb_tree; "sah": of the tree for axis-aligned boxes
    const char* boxes;       ///< "obb"; "aabb turned": by 15 axes; "aabb reboxed": by 3
    std::size_t node_bytes;  ///< of the box and the link
    /// Returns what answers a question for a pose of the second mesh. Both meshes outlive it.
    std::function<std::function<PairWork(const Transform& pose)>(const MeshTrees& a, const MeshTrees& b, PairQuestion)>
        walk;
};
[[nodiscard]] std::span<const TreeKind> all_tree_kinds();

// A second mesh whose surface runs along that of the first, at a distance: where oriented boxes save most.

struct ParallelSurface {
    Mesh mesh;       ///< turned at random, so that the boxes of the two meshes have different axes
    Transform pose;  ///< turns it back
};

/// Moves each vertex by `gap` along the mean of the normals of the triangles there. The two surfaces touch where the
/// first one has another part within the gap.
[[nodiscard]] ParallelSurface parallel_surface_of(const Mesh& mesh, double gap);

}  // namespace espalier::bench
