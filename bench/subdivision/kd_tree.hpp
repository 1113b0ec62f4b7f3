// A k-d tree: space is split by planes across the axes, and each leaf has the triangles that touch its box.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cells.hpp"

namespace espalier::bench {

/// A node of 8 bytes. The first child follows its parent.
struct KdNode {
    union {
        float split;          ///< where the plane is
        std::uint32_t first;  ///< of a leaf, in the references
    };
    std::uint32_t axis_and_rest;  ///< 0 to 2 and the second child, or 3 and the number of a leaf's references

    [[nodiscard]] bool is_leaf() const { return (axis_and_rest & 3u) == 3u; }
    [[nodiscard]] std::size_t axis() const { return axis_and_rest & 3u; }
    [[nodiscard]] std::uint32_t rest() const { return axis_and_rest >> 2; }
};
static_assert(sizeof(KdNode) == 8);

/// Splits have the least expected cost (MacDonald, Booth 1990), of planes beside the ends of all triangles where there
/// are few, and of 32 planes along each axis where there are many; with the costs and the bonus for empty space of "On
/// building fast kd-trees for ray tracing" (Wald, Havran 2006).
class KdTree {
public:
    /// `margin`: of boxes, when triangles are put into them. The triangles outlive the tree. Rays
    /// test triangles in double, or by `float_test`.
    KdTree(std::span<const FloatTriangle> triangles, float margin, const FloatTest* float_test = nullptr);

    /// Returns t of the closest hit, or infinity.
    [[nodiscard]] double closest(const Ray& ray, CellWork& work);
    /// Counts the triangles that touch the box.
    [[nodiscard]] std::size_t count_touching(const Aabb& box, CellWork& work);

    [[nodiscard]] std::size_t nodes() const { return nodes_.size(); }
    [[nodiscard]] std::size_t references() const { return references_.size(); }
    /// Returns the bytes beside the triangles.
    [[nodiscard]] std::size_t bytes() const {
        return nodes_.size() * sizeof(KdNode) + references_.size() * sizeof(std::uint32_t) + mailboxes_.bytes();
    }

private:
    struct Split {
        std::size_t axis = 3;  ///< 3: none is worth it
        float at = 0.0f;
    };
    struct Waiting {
        std::uint32_t node;
        float enter, leave;
    };
    class SplitSearch;
    void try_ends(SplitSearch& search, std::size_t axis, std::span<const std::uint32_t> triangles) const;
    void try_bins(SplitSearch& search, std::size_t axis, const Aabb& box,
                  std::span<const std::uint32_t> triangles) const;
    [[nodiscard]] Split best_split(const Aabb& box, std::span<const std::uint32_t> triangles) const;
    void build(const Aabb& box, std::vector<std::uint32_t> triangles, unsigned depth);
    [[nodiscard]] std::span<const std::uint32_t> triangles_of(const KdNode& leaf) const {
        return std::span(references_).subspan(leaf.first, leaf.rest());
    }

    std::span<const FloatTriangle> triangles_;
    float margin_;
    const FloatTest* float_test_;
    Aabb box_;
    unsigned most_depth_ = 0;
    std::vector<KdNode> nodes_;
    std::vector<std::uint32_t> references_;
    std::vector<Waiting> stack_;
    std::vector<std::uint32_t> boxes_stack_;
    Mailboxes mailboxes_;
};

}  // namespace espalier::bench
