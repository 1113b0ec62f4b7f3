// A mesh on the format's lattice, the baker's binary tree over it, and the blobs that are baked from it.
#pragma once

#include <baker/build/binary_tree.hpp>

#include "layouts.hpp"
#include "walk.hpp"

namespace espalier::bench {

struct LadderSubject {
    Mesh mesh;  ///< at the common size; its corners are lattice points, its triangles in the order of the tree
    baker::BinaryTree binary;
    float margin = 0.0f;   ///< by how much boxes are larger than their triangles
    double step = 0.0;     ///< of the lattice
    BakedBlob fast;        ///< nodes of 16 children
    BakedBlob balanced;    ///< nodes of 8 children, and larger leaves
    BakedBlob small_blob;  ///< nodes of 8 children, and the largest leaves

    /// Returns a shape with its boxes.
    [[nodiscard]] BoxedShape boxed(const TreeShape& shape) const;
};

/// Builds as the baker does: binned SAH, then reinsertion. All trees and blobs have the same triangles. Throws
/// std::runtime_error with the mesh's name.
[[nodiscard]] LadderSubject make_subject(Mesh mesh);

/// Returns cubes around the corners of random triangles. Their sides are about a 64th of the mesh's largest side, and
/// all their coordinates are on the lattice.
[[nodiscard]] std::vector<Aabb> boxes_on_surface(const LadderSubject& subject, std::size_t count, std::uint64_t number);

// A second counter, which shares no code with the layouts and their walk: it decides for every node of the shape
// whether a query visits it, without a stack and without an order of visits.

/// What a layout stores of a shape.
struct StoredBoxes {
    bool of_leaves = true;
    bool quantised = false;
};

/// A triangle that a ray hits.
struct TriangleOnRay {
    std::uint32_t triangle;
    float t;
};
/// Returns all triangles that the ray hits, by a test of each.
[[nodiscard]] std::vector<TriangleOnRay> triangles_on(const Ray& ray, const Mesh& mesh);

/// Counts what a walk through a tree of this shape must have counted.
///
/// A ray for the closest hit visits a node exactly if it visits the node's parent, meets the node's box, and enters it
/// no later than it hits any triangle that comes earlier in its order. In this order a node's children come one after
/// the other, each with all that is below it: leaves without a box first, then by entry. This holds because a triangle
/// that was not tested is not hit before the closest hit of the triangles that were.
///
/// A box visits a node exactly if it visits the node's parent and overlaps the node's box.
class Recount {
public:
    /// `margin`: by how much boxes are larger than their triangles.
    Recount(const TreeShape& shape, StoredBoxes stored, const Mesh& mesh, float margin);

    [[nodiscard]] TreeWork closest(const Ray& ray, std::span<const TriangleOnRay> hits) const;
    [[nodiscard]] TreeWork touching(const Aabb& box) const;

private:
    struct Range {
        float low[3], high[3];
    };
    [[nodiscard]] bool has_box(std::size_t node) const;
    void round_outward();
    [[nodiscard]] TreeWork work_of(const std::vector<char>& is_visited) const;

    const TreeShape* shape_;
    StoredBoxes stored_;
    std::vector<Range> ranges_;
    std::vector<std::uint32_t> leaf_of_triangle_;
};

// The trees that are compared, behind one interface: textbook layouts, and blobs.

struct TreeBytes {
    std::size_t nodes = 0;
    std::size_t node_bytes = 0;  ///< of one
    std::size_t all_bytes = 0;   ///< of the nodes and of the triangles
};

class TreeSystem {
public:
    explicit TreeSystem(std::string name) : name_(std::move(name)) {}
    virtual ~TreeSystem() = default;
    TreeSystem(const TreeSystem&) = delete;
    TreeSystem& operator=(const TreeSystem&) = delete;

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] virtual unsigned degree() const = 0;
    [[nodiscard]] virtual TreeBytes bytes() const = 0;

    /// Returns t of the closest hit, or infinity. Adds the work where that is asked for, of a blob without box tests.
    [[nodiscard]] virtual float closest(const Ray& ray, TreeWork* work) = 0;
    /// Returns how many triangles touch the box. Adds the work where that is asked for.
    [[nodiscard]] virtual std::uint64_t count_touching(const Aabb& box, TreeWork* work) = 0;

    /// Throws std::runtime_error if a second counter counts other work for one of the queries. `hits` has the triangles
    /// on each ray.
    virtual void recount(std::span<const Ray> rays, std::span<const std::vector<TriangleOnRay>> hits,
                         std::span<const Aabb> boxes) = 0;

    /// Whether answers are those of the same test of triangles in double; a blob's are exact.
    [[nodiscard]] virtual bool is_textbook() const = 0;

private:
    std::string name_;
};

/// The shapes over one binary tree that the systems are made from.
struct LadderShapes {
    LadderShapes(const LadderSubject& subject, unsigned leaf_triangles);
    TreeShape single;  ///< a triangle in each leaf
    TreeShape several;
    TreeShape wide_4, wide_8, wide_16;  ///< with the leaves of `several`
};

using TreeSystems = std::vector<std::unique_ptr<TreeSystem>>;
/// Returns the steps of the ladder.
[[nodiscard]] TreeSystems ladder_systems(const LadderSubject& subject, const LadderShapes& shapes);
/// Returns the trees of each degree.
[[nodiscard]] TreeSystems degree_systems(const LadderSubject& subject, const LadderShapes& shapes);

[[nodiscard]] std::unique_ptr<TreeSystem> make_blob_system(const std::string& name, const BakedBlob& baked);

}  // namespace espalier::bench
