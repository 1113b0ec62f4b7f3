#include <espalier/format.hpp>

#include <baker/base/byte_writer.hpp>
#include <baker/encode/leaf.hpp>
#include <baker/encode/node.hpp>

namespace espalier::baker {

void put_plain_node(const NodeToWrite& from, std::byte* bytes, std::vector<std::byte>& leaves) {
    namespace layout = format::plain_node;
    const WideNode& node = from.node;
    const unsigned unit_shift = format::unit_shift(from.mesh.lattice.bits);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < from.boxes.size(); ++i) {
            std::byte* const planes_of_child = bytes + layout::row_bytes * axis + 2 * i;
            // mutant(+ -> -, + -> right side dropped) equivalent: lo_at is 0
            set_u16(planes_of_child + layout::lo_at, static_cast<std::uint32_t>(from.boxes[i].lo[axis]) >> unit_shift);
            set_u16(planes_of_child + layout::hi_at, static_cast<std::uint32_t>(from.boxes[i].hi[axis]) >> unit_shift);
        }
    }
    set_u32(bytes + layout::children_at, node.first_child | std::uint32_t{node.node_children} << 24);
    set_u8(bytes + layout::leaf_children_at, node.leaves);
    if (node.leaves == 0) return;
    const std::size_t block = leaves.size();
    set_u32(bytes + layout::leaf_block_at, static_cast<std::uint32_t>(block / 4));
    for (std::uint32_t i = 0; i < node.leaves; ++i) {
        const std::uint32_t descriptor = put_plain_leaf(from.mesh, from.wide, node.first_leaf + i, block, leaves);
        set_u24(bytes + layout::leaves_at + format::plain_leaf::descriptor_bytes * i, descriptor);
    }
}

}  // namespace espalier::baker
