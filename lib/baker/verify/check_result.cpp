#include <baker/verify/check_result.hpp>

#include <runtime/base/bits.hpp>

#include <baker/verify/check_tree.hpp>

namespace espalier::baker {

namespace {

/// Returns the section of corners of a deformable blob, which a guard, the vertex sources and the origin of the source
/// follow, or nothing.
std::optional<std::span<const std::byte>> find_corners(std::span<const std::byte> blob, std::uint32_t triangles) {
    namespace header = format::header;
    const std::uint32_t positions = detail::load_u32(blob.data() + header::position_count_at);
    const std::uint32_t slots = detail::load_u32(blob.data() + header::vertex_slots_at);
    const auto padded = [](std::size_t bytes) { return (bytes + 3) / 4 * 4; };
    const std::size_t corner_bytes = 3 * std::size_t{triangles};
    const std::uint32_t features = detail::load_u32(blob.data() + header::features_at);
    const std::size_t origin = (features & format::feature::source_origin) != 0 ? format::source_origin::bytes : 0;
    const std::size_t behind =
        padded(corner_bytes) + 64 + padded(std::size_t{slots} * (positions <= 65536 ? 2 : 4)) + origin;
    if (behind > blob.size()) return std::nullopt;
    return blob.subspan(blob.size() - behind, corner_bytes);
}

bool is_same(const Coordinates& decoded, const LatticePoint& meant) {
    return decoded[0] == meant.x && decoded[1] == meant.y && decoded[2] == meant.z;
}

}  // namespace

std::optional<std::string> check_result(std::span<const std::byte> blob, const LatticeMesh& mesh,
                                        const BinaryTree& binary, const WideTree& wide) {
    namespace header = format::header;
    const std::uint32_t node_count = detail::load_u32(blob.data() + header::node_count_at);
    const std::uint32_t leaf_bytes = detail::load_u32(blob.data() + header::leaf_bytes_at);
    const std::uint32_t triangle_count = detail::load_u32(blob.data() + header::triangle_count_at);
    const auto profile = static_cast<Profile>(detail::load_u8(blob.data() + header::profile_at));
    const std::size_t node_bytes = node_count * format::node_bytes(profile);
    if (blob.size() < header::bytes + node_bytes + leaf_bytes + format::guard_bytes)
        return "the header counts too many bytes";
    const auto extent_at = [&](std::size_t axis) {
        return static_cast<std::int32_t>(detail::load_u32(blob.data() + header::extent_at + 4 * axis));
    };
    TreeBytes tree{blob.subspan(header::bytes, node_bytes),
                   blob.subspan(header::bytes + node_bytes, leaf_bytes),
                   detail::load_u8(blob.data() + header::bits_at),
                   profile,
                   wide.copies != 0,
                   {extent_at(0), extent_at(1), extent_at(2)}};

    if (mesh.is_deformable) {
        const auto corners = find_corners(blob, triangle_count);
        if (!corners) return "the corners and the vertex sources do not fit into the bytes";
        tree.corners = *corners;
    }

    std::size_t leaf_number = 0;
    const auto check_leaf = [&](const DecodedLeaf& leaf, const DecodedBox& region) -> std::optional<std::string> {
        if (leaf_number >= wide.leaves.size()) return "there are more leaves than were meant";
        // The boxes of the tree hold every point of every triangle, so boxes around them do.
        const BinaryNode& meant_box = binary.nodes[wide.leaves[leaf_number++].binary_node];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (double(meant_box.lo[axis]) < region.lo[axis] || double(meant_box.hi[axis]) > region.hi[axis])
                return "a part that was meant sticks out of the boxes on the way";
        }
        for (unsigned i = 0; i < leaf.triangle_count; ++i) {
            const std::size_t storage_index = std::size_t{leaf.first_triangle} + i;
            if (storage_index >= wide.triangles.size()) return "there are more triangles than were meant";
            const LatticeTriangle& meant = mesh.triangles[wide.triangles[storage_index]];
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::size_t meant_corner = (corner + wide.first_corners[storage_index]) % 3;
                if (is_same(leaf.vertices[leaf.corners[i][corner]], mesh.vertices[meant.corners[meant_corner]]))
                    continue;
                return "triangle " + std::to_string(storage_index) + " is not the one that was meant (corner " +
                       std::to_string(corner) + ")";
            }
        }
        return std::nullopt;
    };
    TreeCounts counts;
    if (auto complaint = check_tree(tree, check_leaf, counts)) return complaint;
    if (counts.triangles != wide.triangles.size() || counts.triangles != triangle_count) {
        return "there are " + std::to_string(counts.triangles) + " triangles instead of " +
               std::to_string(wide.triangles.size());
    }
    if (counts.depth != wide.depth || counts.depth != detail::load_u8(blob.data() + header::depth_at)) {
        return "the tree is " + std::to_string(counts.depth) + " nodes deep instead of " + std::to_string(wide.depth);
    }
    return std::nullopt;
}

}  // namespace espalier::baker
