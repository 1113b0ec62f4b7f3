#include "refit/deform.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace espalier::fuzz {

using namespace tests;

namespace {

/// Calls `visit` with each leaf.
template <class Blob, class Visit>
void for_each_leaf(Blob& blob, Visit visit) {
    for (auto& node : blob.nodes)
        for (auto& child : node.children)
            if (child.leaf) visit(*child.leaf);
}

}  // namespace

bool can_deform(const PlainBlob& blob) {
    const DecodedBlob& head = blob.decoded;
    if (head.profile != Profile::fast) return false;
    for (const float origin : head.origin)
        if (std::abs(std::ldexp(double(origin), -head.step_exponent)) >= 0x1p126) return false;
    bool has_triangles = false;
    for_each_leaf(blob, [&](const PlainLeaf& leaf) { has_triangles |= !leaf.triangles.empty(); });
    return has_triangles;
}

void deform(PlainBlob& blob, Random& random) {
    DecodedBlob& head = blob.decoded;
    head.features = (head.features & ~format::feature::not_deformable) | format::feature::deformable;
    head.edge_flags.clear();
    head.oriented_box.clear();
    head.sphere.clear();
    head.k_dop.clear();
    const bool share = random.coin();
    std::map<GridPoint, std::uint32_t> shared;
    std::uint32_t count = 0;
    constexpr std::int32_t far = 1 << 30;
    head.pose = {{far, far, far}, {0, 0, 0}};
    for_each_leaf(blob, [&](PlainLeaf& leaf) {
        for (const GridPoint& vertex : leaf.vertices) {
            const auto [found, is_new] = shared.try_emplace(vertex, count);
            leaf.sources.push_back(share ? found->second : count);
            if (is_new || !share) ++count;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                head.pose.low[axis] = std::min(head.pose.low[axis], vertex[axis]);
                head.pose.high[axis] = std::max(head.pose.high[axis], vertex[axis]);
            }
        }
    });
    const std::uint32_t unused = random.below(4) == 0 ? 0x10000 : random.below(3);
    for_each_leaf(blob, [&](PlainLeaf& leaf) {
        for (std::uint32_t& source : leaf.sources) source += unused;
    });
    head.position_count = count + unused;
    head.rest_cost = std::ldexp(1.0f + random.unit(), random.between(-100, 100));
}

}  // namespace espalier::fuzz
