#include <algorithm>
#include <bit>
#include <span>

#include <espalier/format.hpp>

#include <baker/base/byte_writer.hpp>
#include <baker/encode/leaf.hpp>

namespace espalier::baker {

namespace {

using namespace format::plain_leaf;

/// A leaf's vertices, numbered by first use.
struct NumberedVertices {
    unsigned count = 0;
    std::array<std::uint32_t, max_vertices> vertices{};
    std::array<std::array<std::uint8_t, 3>, max_triangles> corners{};

    NumberedVertices(const LatticeMesh& mesh, std::span<const std::uint32_t> triangles) {
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = mesh.triangles[triangles[i]].corners[corner];
                const auto end = vertices.begin() + count;
                const auto found = std::find(vertices.begin(), end, vertex);
                // mutant(- -> +) equivalent: iterators cannot be added, so the mutant is the original
                corners[i][corner] = static_cast<std::uint8_t>(found - vertices.begin());
                if (found == end) vertices[count++] = vertex;
            }
        }
    }

    /// The largest of the leaf's sides.
    [[nodiscard]] std::uint32_t size(const LatticeMesh& mesh) const {
        std::int32_t largest = 0;
        // mutant(< -> <=) equivalent: z once more
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto coordinate = [&](std::uint32_t vertex) { return coordinate_of(mesh.vertices[vertex], axis); };
            std::int32_t low = coordinate(vertices[0]), high = low;
            for (unsigned i = 1; i < count; ++i) {
                low = std::min(low, coordinate(vertices[i]));
                high = std::max(high, coordinate(vertices[i]));
            }
            largest = std::max(largest, high - low);
        }
        return static_cast<std::uint32_t>(largest);
    }
};

/// The least size of a descriptor that is true.
unsigned size_field(std::uint32_t largest_side, unsigned bits) {
    const auto size = static_cast<unsigned>(std::bit_width(largest_side));
    return std::max(size, least_size(bits)) - least_size(bits);
}

}  // namespace

PlainLeafRows rows_of_plain_leaf(const LatticeMesh& mesh, const WideTree& wide, std::uint32_t number) {
    const Leaf& leaf = wide.leaves[number];
    const NumberedVertices numbered(mesh, std::span(wide.triangles).subspan(leaf.first, leaf.count));
    PlainLeafRows rows{{numbered.vertices.begin(), numbered.vertices.begin() + numbered.count}, {}};
    for (std::size_t corner = 0; corner < 3; ++corner)
        for (std::uint32_t i = 0; i < leaf.count; ++i) rows.corners.push_back(numbered.corners[i][corner]);
    return rows;
}

std::uint32_t put_plain_leaf(const LatticeMesh& mesh, const WideTree& wide, std::uint32_t number, std::size_t block,
                             std::vector<std::byte>& bytes) {
    const Leaf& leaf = wide.leaves[number];
    const unsigned bits = mesh.lattice.bits;
    const NumberedVertices numbered(mesh, std::span(wide.triangles).subspan(leaf.first, leaf.count));
    const auto offset = static_cast<std::uint32_t>((bytes.size() - block) / 4);
    const auto for_each_coordinate = [&](auto put) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (unsigned i = 0; i < numbered.count; ++i)
                put(static_cast<std::uint32_t>(coordinate_of(mesh.vertices[numbered.vertices[i]], axis)));
    };
    put_u32(bytes, leaf.first);
    for_each_coordinate([&](std::uint32_t coordinate) { put_u16(bytes, coordinate & 0xFFFF); });
    if (!mesh.is_deformable)
        for (std::size_t corner = 0; corner < 3; ++corner)
            for (std::uint32_t i = 0; i < leaf.count; ++i) put_u8(bytes, numbered.corners[i][corner]);
    if (has_high_bytes(bits)) for_each_coordinate([&](std::uint32_t coordinate) { put_u8(bytes, coordinate >> 16); });
    pad_to(bytes, 4);
    return offset | (leaf.count - 1) << triangles_shift | (numbered.count - 1) << vertices_shift |
           size_field(numbered.size(mesh), bits) << size_shift;
}

}  // namespace espalier::baker
