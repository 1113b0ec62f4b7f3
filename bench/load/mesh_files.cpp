#include "mesh_files.hpp"

#include <cstring>
#include <stdexcept>

namespace espalier::bench {

MeshCounts read_counts(std::span<const std::byte> file) {
    MeshCounts counts;
    if (file.size() < sizeof counts) throw std::runtime_error("a file of a mesh is too short");
    std::memcpy(&counts, file.data(), sizeof counts);
    return counts;
}

Bytes write_floats(const Mesh& mesh) {
    const MeshCounts counts = {static_cast<std::uint32_t>(mesh.positions.size()),
                               static_cast<std::uint32_t>(mesh.triangles.size())};
    const std::size_t positions = 12 * mesh.positions.size(), corners = 12 * mesh.triangles.size();
    Bytes file(sizeof counts + positions + corners);
    std::memcpy(file.data(), &counts, sizeof counts);
    std::memcpy(file.data() + sizeof counts, mesh.positions.data(), positions);
    std::memcpy(file.data() + sizeof counts + positions, mesh.triangles.data(), corners);
    return file;
}

void read_floats(std::span<const std::byte> file, const MeshArrays& to) {
    const MeshCounts counts = read_counts(file);
    const std::size_t positions = 12 * std::size_t{counts.vertices}, corners = 12 * std::size_t{counts.triangles};
    if (file.size() != sizeof counts + positions + corners) throw std::runtime_error("a file of floats is damaged");
    std::memcpy(to.positions, file.data() + sizeof counts, positions);
    std::memcpy(to.corners, file.data() + sizeof counts + positions, corners);
}

}  // namespace espalier::bench
