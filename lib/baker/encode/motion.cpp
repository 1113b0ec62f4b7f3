#include <baker/encode/motion.hpp>

#include <algorithm>
#include <bit>

#include <espalier/blob.hpp>
#include <runtime/blob/tree_cost.hpp>

#include <baker/base/byte_writer.hpp>
#include <baker/encode/leaf.hpp>

namespace espalier::baker {

std::uint32_t put_corners_and_sources(std::vector<std::byte>& blob, const LatticeMesh& mesh, const WideTree& wide) {
    for (std::uint32_t leaf = 0; leaf < wide.leaves.size(); ++leaf)
        for (const std::uint8_t corner : rows_of_plain_leaf(mesh, wide, leaf).corners) put_u8(blob, corner);
    pad_to(blob, 4);
    blob.resize(blob.size() + format::corners::guard_bytes);
    const bool is_short = format::vertex_sources::number_bits(static_cast<std::uint32_t>(mesh.vertices.size())) == 16;
    std::uint32_t count = 0;
    for (const WideNode& node : wide.nodes) {
        for (std::uint32_t i = 0; i < node.leaves; ++i) {
            for (const std::uint32_t vertex : rows_of_plain_leaf(mesh, wide, node.first_leaf + i).vertices) {
                if (is_short) put_u16(blob, vertex);
                else put_u32(blob, vertex);
                ++count;
            }
        }
    }
    pad_to(blob, 4);
    return count;
}

void put_motion(std::byte* header, const LatticeMesh& mesh, std::uint32_t vertex_slots, const EncodedTree& tree) {
    using namespace format::header;
    set_u32(header + position_count_at, static_cast<std::uint32_t>(mesh.vertices.size()));
    set_u32(header + vertex_slots_at, vertex_slots);
    detail::BlobData nodes;
    nodes.nodes = tree.nodes.data();
    nodes.node_count = static_cast<std::uint32_t>(tree.nodes.size() / format::plain_node::bytes);
    set_u32(header + rest_cost_at, std::bit_cast<std::uint32_t>(detail::cost_of_tree(nodes)));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::int32_t low = coordinate_of(mesh.extent, axis), high = 0;
        for (const LatticeTriangle& triangle : mesh.triangles) {
            for (const std::uint32_t corner : triangle.corners) {
                low = std::min(low, coordinate_of(mesh.vertices[corner], axis));
                high = std::max(high, coordinate_of(mesh.vertices[corner], axis));
            }
        }
        set_u32(header + pose_low_at + 4 * axis, static_cast<std::uint32_t>(low));
        set_u32(header + pose_high_at + 4 * axis, static_cast<std::uint32_t>(high));
    }
}

}  // namespace espalier::baker
