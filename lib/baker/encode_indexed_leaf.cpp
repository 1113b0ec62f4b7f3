#include <algorithm>
#include <span>
#include <utility>

#include <espalier/format.hpp>

#include "byte_writer.hpp"
#include "encode_leaf.hpp"

namespace espalier::baker {

namespace {

using namespace format::indexed_leaf;

/// The least code whose width holds `largest`.
unsigned width_code(std::uint32_t largest, unsigned bits) {
    unsigned code = 0;
    while (largest >> format::indexed_leaf::coordinate_width(code, bits) != 0) ++code;
    return code;
}

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

    /// The least and the largest coordinate.
    [[nodiscard]] std::pair<std::int32_t, std::int32_t> extremes(const LatticeMesh& mesh, std::size_t axis) const {
        std::int32_t least = coordinate_of(mesh.vertices[vertices[0]], axis);
        std::int32_t largest = least;
        for (unsigned i = 1; i < count; ++i) {
            const std::int32_t coordinate = coordinate_of(mesh.vertices[vertices[i]], axis);
            least = std::min(least, coordinate);
            largest = std::max(largest, coordinate);
        }
        return {least, largest};
    }
};

}  // namespace

std::uint32_t put_indexed_leaf(const LatticeMesh& mesh, const WideTree& wide, std::uint32_t number, const LeafBox& box,
                               const LeafBlock& block, std::vector<std::byte>& bytes) {
    pad_to(bytes, 2);
    const Leaf& leaf = wide.leaves[number];
    const NumberedVertices numbered(mesh, std::span(wide.triangles).subspan(leaf.first, leaf.count));
    std::uint32_t descriptor = static_cast<std::uint32_t>((bytes.size() - block.data) / 2);
    descriptor |= (leaf.count - 1) << triangles_shift | (numbered.count - 1) << vertices_shift;
    BitStream stream(bytes);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [least, largest] = numbered.extremes(mesh, axis);
        const unsigned bits = mesh.lattice.bits;
        // Vertices below the box, which parts of triangles have, count from 0, in the lattice's own width.
        const unsigned code = least < box.anchor[axis]
                                  ? width_code((1u << bits) - 1u, bits)
                                  : width_code(static_cast<std::uint32_t>(largest - box.anchor[axis]), bits);
        descriptor |= code << (widths_shift + 4 * axis);
        const unsigned width = coordinate_width(code, bits);
        const std::int32_t start = wide.copies != 0 && width == bits ? 0 : box.anchor[axis];
        for (unsigned i = 0; i < numbered.count; ++i) {
            const std::int32_t coordinate = coordinate_of(mesh.vertices[numbered.vertices[i]], axis);
            stream.put(static_cast<std::uint32_t>(coordinate - start), width);
        }
        stream.finish();
    }
    const unsigned width = corner_width(numbered.count);
    for (std::uint32_t i = 0; i < leaf.count; ++i) {
        const auto [a, b, c] = numbered.corners[i];
        stream.put(std::uint32_t{a} | std::uint32_t{b} << width | std::uint32_t{c} << (2 * width), 3 * width);
    }
    stream.finish();
    return descriptor;
}

}  // namespace espalier::baker
