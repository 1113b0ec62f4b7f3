// The codecs of meshoptimizer: compiled where it is installed.

#include <meshoptimizer.h>

#include "ways.hpp"

namespace espalier::bench {
namespace {

using Steps = std::array<std::uint16_t, 4>;  // the last is 0

struct Header {
    MeshCounts counts;
    std::uint32_t vertex_bytes;
    std::uint32_t triangle_bytes;
    float origin[3];
    float step;
};

struct LatticePositions {
    float origin[3];
    std::vector<Steps> steps;
};

LatticePositions positions_in_steps(const SnappedMesh& snapped) {
    const auto coordinate = [](const Vec3& p, std::size_t axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; };
    LatticePositions result{{}, std::vector<Steps>(snapped.mesh.positions.size(), Steps{})};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        float least = std::numeric_limits<float>::infinity();
        for (const Vec3& p : snapped.mesh.positions) least = std::min(least, coordinate(p, axis));
        result.origin[axis] = least;
        for (std::size_t i = 0; i < result.steps.size(); ++i) {
            const double steps = (double(coordinate(snapped.mesh.positions[i], axis)) - double(least)) / snapped.step;
            if (steps > 65535.0 || steps != std::floor(steps))
                throw std::invalid_argument(snapped.mesh.name + " is not on a lattice of 16 bits");
            result.steps[i][axis] = static_cast<std::uint16_t>(steps);
        }
    }
    return result;
}

}  // namespace

Bytes write_meshopt(const SnappedMesh& snapped) {
    const LatticePositions positions = positions_in_steps(snapped);
    std::vector<std::uint32_t> corners;
    for (const TriangleVertices& triangle : snapped.mesh.triangles)
        corners.insert(corners.end(), triangle.begin(), triangle.end());
    meshopt_optimizeVertexCacheStrip(corners.data(), corners.data(), corners.size(), positions.steps.size());
    std::vector<Steps> vertices(positions.steps.size());
    vertices.resize(meshopt_optimizeVertexFetch(vertices.data(), corners.data(), corners.size(), positions.steps.data(),
                                                positions.steps.size(), sizeof(Steps)));
    meshopt_encodeIndexVersion(1);
    std::vector<unsigned char> streams(meshopt_encodeVertexBufferBound(vertices.size(), sizeof(Steps)) +
                                       meshopt_encodeIndexBufferBound(corners.size(), vertices.size()));
    Header header{};
    header.counts = {static_cast<std::uint32_t>(vertices.size()),
                     static_cast<std::uint32_t>(snapped.mesh.triangles.size())};
    header.vertex_bytes = static_cast<std::uint32_t>(
        meshopt_encodeVertexBuffer(streams.data(), streams.size(), vertices.data(), vertices.size(), sizeof(Steps)));
    header.triangle_bytes = static_cast<std::uint32_t>(meshopt_encodeIndexBuffer(
        streams.data() + header.vertex_bytes, streams.size() - header.vertex_bytes, corners.data(), corners.size()));
    std::copy_n(positions.origin, 3, header.origin);
    header.step = static_cast<float>(snapped.step);
    Bytes file(sizeof header + header.vertex_bytes + header.triangle_bytes);
    std::memcpy(file.data(), &header, sizeof header);
    std::memcpy(file.data() + sizeof header, streams.data(), file.size() - sizeof header);
    return file;
}

void read_meshopt(std::span<const std::byte> file, const MeshArrays& to) {
    Header header;
    if (file.size() < sizeof header) throw std::runtime_error("a file of meshoptimizer is too short");
    std::memcpy(&header, file.data(), sizeof header);
    const auto* streams = reinterpret_cast<const unsigned char*>(file.data()) + sizeof header;
    std::vector<Steps> vertices(header.counts.vertices);
    const bool is_sound =
        file.size() == sizeof header + header.vertex_bytes + header.triangle_bytes &&
        meshopt_decodeVertexBuffer(vertices.data(), vertices.size(), sizeof(Steps), streams, header.vertex_bytes) ==
            0 &&
        meshopt_decodeIndexBuffer(to.corners, 3 * std::size_t{header.counts.triangles}, sizeof(std::uint32_t),
                                  streams + header.vertex_bytes, header.triangle_bytes) == 0;
    if (!is_sound) throw std::runtime_error("a file of meshoptimizer is damaged");
    // A lattice point times a power of two, and its sum with a multiple of it, are floats.
    for (std::size_t i = 0; i < vertices.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            to.positions[3 * i + axis] = header.origin[axis] + header.step * static_cast<float>(vertices[i][axis]);
}

}  // namespace espalier::bench
