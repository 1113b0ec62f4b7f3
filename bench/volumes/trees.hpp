// Trees of one topology with volumes of each kind in their nodes.
#pragma once

#include "../study/aabb_tree.hpp"
#include "../study/shapes.hpp"
#include "../study/walks.hpp"

namespace espalier::bench {

/// Fits volumes to the triangles of each node. One entry for each node of the tree.
[[nodiscard]] std::vector<Volumes> fit_nodes(const AabbTree& topology);

// The kinds of volume behind one interface, which is called once for a query.

/// Tests of volumes that a walk made, in its order.
struct RayTests {
    Ray ray;
    std::vector<std::uint32_t> nodes;
};
struct PairTests {
    Placement placement;
    std::vector<std::array<std::uint32_t, 2>> nodes;  ///< of the first tree and of the placed one
};

/// A tree whose nodes have volumes of one kind.
class KindOfTree {
public:
    virtual ~KindOfTree() = default;
    [[nodiscard]] virtual Kind kind() const = 0;
    [[nodiscard]] virtual std::size_t volume_bytes() const = 0;
    [[nodiscard]] virtual std::size_t node_bytes() const = 0;

    /// Returns t of the closest hit, or infinity.
    [[nodiscard]] virtual double closest(const Ray& ray, RayWork& work) = 0;
    /// Returns how many triangles the ball touches.
    [[nodiscard]] virtual std::uint64_t touching(const Ball& ball, RayWork& work) = 0;
    /// Returns how many pairs of triangles touch, of the mesh and the same mesh in a pose.
    [[nodiscard]] virtual std::uint64_t touching(const Placement& placement, RayWork& work) = 0;

    [[nodiscard]] virtual RayTests tests_of(const Ray& ray) = 0;
    [[nodiscard]] virtual PairTests tests_of(const Placement& placement) = 0;
    /// Makes the tests alone, again and again, and returns the nanoseconds of one.
    [[nodiscard]] virtual double time_of(std::span<const RayTests> tests, unsigned repetitions) const = 0;
    /// The same; it includes the share of placing a volume that several tests need.
    [[nodiscard]] virtual double time_of(std::span<const PairTests> tests, unsigned repetitions) const = 0;
};

[[nodiscard]] std::string_view name_of(Kind kind);

/// Returns a tree of each of all_kinds, with the nodes and triangles of `topology`, which must outlive them.
[[nodiscard]] std::vector<std::unique_ptr<KindOfTree>> trees_of_all_kinds(const AabbTree& topology,
                                                                          std::span<const Volumes> volumes);

}  // namespace espalier::bench
