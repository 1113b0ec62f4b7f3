// A second counter, which shares no code with the layouts and their walk: it decides for every node of the shape
// whether a query visits it, without a stack and without an order of visits.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <espalier/ray.hpp>

#include "../rays.hpp"
#include "shape.hpp"
#include "work.hpp"

namespace espalier::bench {

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

}  // namespace espalier::bench
