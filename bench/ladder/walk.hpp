// What walks through trees count.
#pragma once

#include "../study/aabb_tree.hpp"
#include "../volumes/volume_tests.hpp"
#include "layouts.hpp"

namespace espalier::bench {

struct TreeWork {
    std::uint64_t nodes = 0;  ///< whose children were tested
    std::uint64_t leaves = 0;
    std::uint64_t box_tests = 0;  ///< the root's included
    std::uint64_t triangle_tests = 0;

    void count_node() { ++nodes; }
    void count_box() { ++box_tests; }
    void count_leaf(std::uint32_t triangles) {
        ++leaves;
        triangle_tests += triangles;
    }
    TreeWork& operator+=(const TreeWork& more) {
        nodes += more.nodes;
        leaves += more.leaves;
        box_tests += more.box_tests;
        triangle_tests += more.triangle_tests;
        return *this;
    }
    friend bool operator==(const TreeWork&, const TreeWork&) = default;
};

/// Counts nothing: for walks that are timed.
struct NoWork {
    void count_node() {}
    void count_box() {}
    void count_leaf(std::uint32_t) {}
};

// One walk for every layout: only where the boxes and the links are makes a difference.

inline constexpr float no_hit = std::numeric_limits<float>::infinity();

/// The slabs of boxes (Kay, Kajiya 1986) along one ray.
class RaySlabs {
public:
    explicit RaySlabs(const Ray& ray)
        : origin_{ray.origin.x, ray.origin.y, ray.origin.z},
          inverse_{inverse_of(ray.direction.x), inverse_of(ray.direction.y), inverse_of(ray.direction.z)} {}
    /// Returns t where the ray enters the box, or infinity if it misses the box or enters it behind `nearest`.
    [[nodiscard]] float entry(const Aabb& box, float nearest) const {
        float begin = 0.0f, end = nearest;
        for (std::size_t k = 0; k < 3; ++k) {
            const float low = (box.low[k] - origin_[k]) * inverse_[k], high = (box.high[k] - origin_[k]) * inverse_[k];
            begin = std::max(begin, std::min(low, high));
            end = std::min(end, std::max(low, high));
        }
        return begin <= end ? begin : no_hit;
    }

private:
    std::array<float, 3> origin_, inverse_;
};

inline bool do_overlap(const Aabb& a, const Aabb& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
    return true;
}

/// Walks through a tree, whose leaves name triangles of the mesh.
template <class Tree>
class TreeWalk {
public:
    /// `height`: levels below the root.
    TreeWalk(const Tree& tree, const Mesh& mesh, unsigned height)
        : tree_(&tree), mesh_(&mesh), waiting_(std::size_t{height} * (Tree::degree - 1) + 2) {}

    /// Returns t of the closest hit, or infinity: the nearest child first, the others wait on a stack. A leaf without a
    /// box is tested before its sibling.
    template <class Work>
    [[nodiscard]] float closest(const Ray& ray, Work& work) {
        const RaySlabs slabs(ray);
        const Line line = {point_of(ray.origin), point_of(ray.direction)};
        float nearest = no_hit;
        const auto test_leaf = [&](Link leaf) {
            work.count_leaf(leaf.count());
            for (std::uint32_t i = leaf.first(); i < leaf.first() + leaf.count(); ++i)
                if (const auto at = meets(corners_of(*mesh_, mesh_->triangles[i]), line))
                    nearest = std::min(nearest, static_cast<float>(*at));
        };
        work.count_box();
        std::size_t size = 0;
        if (const float at = slabs.entry(tree_->root_box(), nearest); at != no_hit)
            waiting_[size++] = {tree_->root(), at};
        while (size > 0) {
            const Waiting next = waiting_[--size];
            if (next.entry > nearest) continue;
            Link link = next.link;
            while (!link.is_leaf()) {
                work.count_node();
                std::array<Waiting, Tree::degree> entered;
                std::size_t count = 0;
                tree_->visit_children(link, test_leaf, [&](Link child, const Aabb& box) {
                    work.count_box();
                    const float at = slabs.entry(box, nearest);
                    if (at == no_hit) return;
                    std::size_t place = count++;
                    for (; place > 0 && entered[place - 1].entry > at; --place) entered[place] = entered[place - 1];
                    entered[place] = {child, at};
                });
                if (count == 0) break;
                while (count > 1) waiting_[size++] = entered[--count];
                link = entered[0].link;
            }
            if (link.is_leaf()) test_leaf(link);
        }
        return nearest;
    }

    /// Counts the triangles that touch a box.
    template <class Work>
    [[nodiscard]] std::uint64_t count_touching(const Aabb& box, Work& work) {
        const TriangleBoxTest test(box);
        std::uint64_t touching = 0;
        const auto test_leaf = [&](Link leaf) {
            work.count_leaf(leaf.count());
            for (std::uint32_t i = leaf.first(); i < leaf.first() + leaf.count(); ++i)
                touching += test.touches(corners_of(*mesh_, mesh_->triangles[i])) ? 1u : 0u;
        };
        std::size_t size = 0;
        const auto test_box = [&](Link link, const Aabb& of_node) {
            work.count_box();
            if (do_overlap(of_node, box)) waiting_[size++].link = link;
        };
        test_box(tree_->root(), tree_->root_box());
        while (size > 0) {
            const Link link = waiting_[--size].link;
            if (link.is_leaf()) {
                test_leaf(link);
                continue;
            }
            work.count_node();
            tree_->visit_children(link, test_leaf, test_box);
        }
        return touching;
    }

private:
    struct Waiting {
        Link link;
        float entry;
    };
    const Tree* tree_;
    const Mesh* mesh_;
    std::vector<Waiting> waiting_;
};

}  // namespace espalier::bench
