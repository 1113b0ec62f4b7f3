// What the collapse minimises, in one place to tune. All constants are committed: no timing ever enters the bytes.
#pragma once

#include <span>

#include <espalier/bake.hpp>

namespace espalier::baker {

/// The expected cost of a ray, in visits of a node, plus a price on bytes:
/// sum over nodes and leaves of (area relative to the root's) * cost + byte_price * bytes stored / triangles.
struct CostModel {
    float node_visit = 1.0f;
    float leaf_visit = 0.7f;  ///< for each started group of 8 triangles
    float triangle = 0.0f;    ///< for each triangle of a visited leaf
    float byte_price = 5.0f;  ///< of one byte a triangle
};

/// As espalier::bake, with another model: for tuning and for tests.
[[nodiscard]] Result<Baked, BakeError> bake_with_cost_model(std::span<const MeshView> meshes,
                                                            const BakeOptions& options, const CostModel& cost_model);

}  // namespace espalier::baker
