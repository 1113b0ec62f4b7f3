#include "motion.hpp"

#include <vector>

#include <espalier/deformation.hpp>

namespace espalier::tools {

Motion motion_of(const Blob& blob) {
    std::vector<std::byte> memory(deformable_bytes(blob));
    const Deformable mesh = create_deformable(blob, memory);
    return {mesh.position_count(), mesh.range(), memory.size()};
}

Json motion_json(const Blob& blob) {
    const Motion motion = motion_of(blob);
    return {{"positions", motion.positions},
            {"range", {{"min", json_point(motion.range.min)}, {"max", json_point(motion.range.max)}}},
            {"moving_bytes", motion.moving_bytes},
            {"moving_bytes_per_triangle", static_cast<double>(motion.moving_bytes) / blob.triangle_count()}};
}

}  // namespace espalier::tools
