// A ray through a hierarchy: in which order the children of a node are visited.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include <espalier/ray.hpp>

#include "../volumes/tests.hpp"
#include "aabb_tree.hpp"

namespace espalier::bench {

enum class RayOrder : std::uint8_t {
    nearest_first,     ///< the child whose box the ray enters first; the other waits on a stack
    nearest_recursed,  ///< the same, with a function that calls itself instead of a stack
    fixed,             ///< the first child of the tree
    farthest_first,    ///< the child whose box the ray enters last
};
inline constexpr std::array all_ray_orders = {RayOrder::nearest_first, RayOrder::nearest_recursed, RayOrder::fixed,
                                              RayOrder::farthest_first};
/// Returns the name in rows.
[[nodiscard]] std::string_view name_of(RayOrder order);

/// What walks of rays count, added up.
struct RayWork {
    std::uint64_t box_tests = 0;
    std::uint64_t triangle_tests = 0;
    std::uint64_t skipped = 0;  ///< boxes that the ray meets, but that begin behind the hit that was found
};

/// Finds the closest hit. The answer is the same in every order.
///
/// A box is tested by its slabs (Kay, Kajiya 1986), a triangle by "Fast, minimum storage ray/triangle intersection"
/// (Möller, Trumbore 1997) in double.
class RayWalk {
public:
    explicit RayWalk(const AabbTree& tree);

    /// Returns t of the closest hit, or infinity.
    [[nodiscard]] double closest(RayOrder order, const Ray& ray, RayWork& work);

private:
    struct Waiting {
        std::uint32_t node;
        float entry;
    };
    const AabbTree* tree_;
    std::vector<Waiting> stack_;
};

/// Returns t of the closest hit by a test of all triangles, without a tree.
[[nodiscard]] double closest_of_all(const AabbTree& tree, const Ray& ray);

}  // namespace espalier::bench
