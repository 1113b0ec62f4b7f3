// What a game or an editor may ship of a mesh: floats, or the streams of meshoptimizer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "../exactness/edge_rays.hpp"

namespace espalier::bench {

using Bytes = std::vector<std::byte>;

/// Where the arrays of a mesh are decoded to, 12 bytes for each vertex and each triangle. A loader allocates them once
/// it has read how many there are.
struct MeshArrays {
    float* positions = nullptr;
    std::uint32_t* corners = nullptr;
};

/// How many vertices and triangles a file has.
struct MeshCounts {
    std::uint32_t vertices = 0;
    std::uint32_t triangles = 0;
};
/// Of both kinds of files.
[[nodiscard]] MeshCounts read_counts(std::span<const std::byte> file);

/// A file of float positions and 32-bit corners.
[[nodiscard]] Bytes write_floats(const Mesh& mesh);
void read_floats(std::span<const std::byte> file, const MeshArrays& to);

/// A file as gltfpack writes it: triangles in the order of its vertex cache optimizer for compression, vertices in the
/// order of their first use, both through meshoptimizer's codecs. Positions are those of the lattice in 16 bits, three
/// and a padding of 0, as glTF requires. The mesh must be snapped to at most 16 bits. Throws std::invalid_argument if
/// it is not.
[[nodiscard]] Bytes write_meshopt(const SnappedMesh& snapped);
/// Decodes, and turns lattice points into floats, exactly. Throws std::runtime_error for damaged bytes.
void read_meshopt(std::span<const std::byte> file, const MeshArrays& to);

}  // namespace espalier::bench
