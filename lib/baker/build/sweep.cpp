#include <baker/build/sweep.hpp>

#include <limits>

namespace espalier::baker {

BinaryTree build_sweep(const LatticeMesh& mesh, const BuildSettings& settings) {
    std::vector<float> right_costs(mesh.triangles.size());
    return build_sorted(mesh, settings, [&](const SortedOrders& orders, std::uint32_t first, std::uint32_t count) {
        SortedSplit best{0, count / 2};
        float least = std::numeric_limits<float>::infinity();
        for (unsigned axis = 0; axis < 3; ++axis) {
            LaneBox right;
            for (std::uint32_t i = count - 1; i > 0; --i) {
                right.add(orders.box_at(axis, first + i));
                right_costs[first + i] = right.half_area() * static_cast<float>(count - i);
            }
            LaneBox left;
            for (std::uint32_t i = 1; i < count; ++i) {
                left.add(orders.box_at(axis, first + i - 1));
                const float cost = left.half_area() * static_cast<float>(i) + right_costs[first + i];
                if (cost >= least) continue;
                least = cost;
                best = {axis, i};
            }
        }
        return best;
    });
}

}  // namespace espalier::baker
