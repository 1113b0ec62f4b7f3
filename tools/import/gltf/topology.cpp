#include "topology.hpp"

#include "base/numbers.hpp"
#include "import/base/polygon.hpp"

namespace espalier::tools {

namespace {

enum Mode : std::uint64_t { points, lines, line_loop, line_strip, triangles = gltf_triangles, strip, fan };

std::uint64_t lines_of(std::uint64_t mode, std::uint64_t corners) {
    if (mode == points) return corners;
    if (mode == lines) return corners / 2;
    if (corners < 2) return 0;
    return mode == line_loop ? corners : corners - 1;
}

/// Refuses the largest value of the indices' type where it would name a vertex: programs that draw take it as the end
/// of a strip, and glTF forbids it.
void refuse_restarts(const GltfObject& object, const GltfAccessor& indices, std::size_t vertices) {
    const std::uint64_t restart = (std::uint64_t{1} << (8 * bytes_of(indices.component))) - 1;
    if (restart >= vertices) return;  // a vertex that is missing, which the baker refuses or drops
    for (std::size_t corner = 0; corner < indices.count; ++corner) {
        if (indices.whole(corner, 0) != restart) continue;
        object.fail(
            text("index ", corner, " is ", restart, ", the largest value of its type, which glTF forbids as an index"));
    }
}

}  // namespace

void read_gltf_topology(const GltfObject& object, std::uint64_t mode, const std::optional<GltfAccessor>& indices,
                        GltfPrimitive& primitive) {
    const std::size_t corners = indices ? indices->count : primitive.positions.count;
    if (mode > fan) object.fail(text("its mode ", mode, " is none"));
    if (mode < triangles) {
        primitive.points_and_lines = lines_of(mode, corners);
        return;
    }
    if (indices) refuse_restarts(object, *indices, primitive.positions.count);
    const auto vertex = [&](std::size_t corner) {
        return indices ? indices->whole(corner, 0) : static_cast<std::uint32_t>(corner);
    };
    if (mode == triangles) {
        primitive.left_over_corners = corners % 3;
        primitive.triangles.reserve(corners / 3);
        for (std::size_t i = 0; i + 2 < corners; i += 3) {
            primitive.triangles.push_back({vertex(i), vertex(i + 1), vertex(i + 2)});
        }
        return;
    }
    if (corners < 3) {
        primitive.left_over_corners = corners;
        return;
    }
    primitive.triangles.reserve(corners - 2);
    for (std::size_t i = 0; i + 2 < corners; ++i) {
        const TriangleVertices triangle =
            mode == strip ? TriangleVertices{vertex(i), vertex(i + 1 + i % 2), vertex(i + 2 - i % 2)}
                          : TriangleVertices{vertex(i + 1), vertex(i + 2), vertex(0)};
        if (!repeats_a_vertex(triangle, primitive.positions.count)) primitive.triangles.push_back(triangle);
    }
}

}  // namespace espalier::tools
