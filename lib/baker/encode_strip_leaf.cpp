#include <algorithm>

#include <espalier/format.hpp>

#include "byte_writer.hpp"
#include "encode_leaf.hpp"

namespace espalier::baker {

namespace {

using namespace format::strip_leaf;

/// A strip's vertices, numbered by first use.
struct NumberedEntries {
    unsigned vertex_count = 0;
    std::array<std::uint32_t, max_small_entries> vertices{};
    std::array<std::uint8_t, max_small_entries> numbers{};
    std::uint64_t first_uses = 0;

    explicit NumberedEntries(const Strip& strip) {
        for (unsigned entry = 0; entry < strip.entry_count; ++entry) {
            const auto end = vertices.begin() + vertex_count;
            const auto found = std::find(vertices.begin(), end, strip.entries[entry]);
            // mutant(- -> +) equivalent: iterators cannot be added, so the mutant is the original
            numbers[entry] = static_cast<std::uint8_t>(found - vertices.begin());
            if (found != end) continue;
            vertices[vertex_count++] = strip.entries[entry];
            first_uses |= std::uint64_t{1} << entry;
        }
    }
    [[nodiscard]] bool is_first_use(unsigned entry) const { return (first_uses >> entry & 1) != 0; }
};

}  // namespace

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
