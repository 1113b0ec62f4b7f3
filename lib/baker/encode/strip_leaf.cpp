#include <espalier/format.hpp>

#include <baker/base/byte_writer.hpp>
#include <baker/collapse/numbered_entries.hpp>
#include <baker/encode/leaf.hpp>

namespace espalier::baker {

using namespace format::strip_leaf;

std::uint32_t put_strip_leaf(const LatticeMesh& mesh, const WideTree& wide, std::uint32_t number, const LeafBox& box,
                             const StripBlock& block, std::vector<std::byte>& bytes) {
    const Strip& strip = wide.strips[number];
    const NumberedEntries numbered(strip);
    const std::uint32_t descriptor = static_cast<std::uint32_t>(bytes.size() - block.data) |
                                     (strip.entry_count - 3) << entries_shift |
                                     (wide.leaves[number].first - block.first_triangle) << first_shift;
    BitStream stream(bytes);
    const unsigned marked = strip.entry_count - 3;
    const auto put_marks = [&](std::uint64_t marks) {
        for (unsigned i = 0; i < marked; ++i) stream.put(static_cast<std::uint32_t>(marks >> i & 1), 1);
    };
    put_marks(strip.pivots >> 1);
    put_marks(strip.windows >> 1);
    put_marks(numbered.first_uses >> 3);
    for (unsigned entry = 3; entry < strip.entry_count; ++entry) {
        if (!numbered.is_first_use(entry)) {
            stream.put(numbered.numbers[entry], reference_width(numbered.vertex_count));
        }
    }
    stream.finish();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const unsigned width = coordinate_width(static_cast<std::uint32_t>(box.side[axis]), mesh.lattice.bits);
        for (unsigned i = 0; i < numbered.vertex_count; ++i) {
            const std::int32_t coordinate = coordinate_of(mesh.vertices[numbered.vertices[i]], axis);
            stream.put(static_cast<std::uint32_t>(coordinate - box.anchor[axis]), width);
        }
        stream.finish();
    }
    return descriptor;
}

}  // namespace espalier::baker
