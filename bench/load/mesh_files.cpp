#include "ways.hpp"

namespace espalier::bench {

MeshCounts read_counts(std::span<const std::byte> file) {
    MeshCounts counts;
    if (file.size() < sizeof counts) throw std::runtime_error("a file of a mesh is too short");
    std::memcpy(&counts, file.data(), sizeof counts);
    return counts;
}

Mesh decoded(std::span<const std::byte> file, ReadMesh read) {
    const MeshCounts counts = read_counts(file);
    Mesh mesh;
    mesh.positions.resize(counts.vertices);
    mesh.triangles.resize(counts.triangles);
    read(file, {&mesh.positions.data()->x, mesh.triangles.data()->data()});
    return mesh;
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

#ifdef ESPALIER_BENCH_ZLIB
#include <zlib.h>

#endif

namespace espalier::bench {

#ifdef ESPALIER_BENCH_ZLIB

std::optional<std::vector<std::byte>> deflate_bytes(std::span<const std::byte> bytes) {
    uLongf size = compressBound(bytes.size());
    std::vector<std::byte> compressed(size);
    if (compress2(reinterpret_cast<Bytef*>(compressed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                  bytes.size(), Z_BEST_COMPRESSION) != Z_OK)
        throw std::runtime_error("zlib cannot compress");
    compressed.resize(size);
    return compressed;
}

std::vector<std::byte> inflate_bytes(std::span<const std::byte> compressed, std::size_t size) {
    std::vector<std::byte> bytes(size);
    uLongf written = size;
    if (uncompress(reinterpret_cast<Bytef*>(bytes.data()), &written, reinterpret_cast<const Bytef*>(compressed.data()),
                   compressed.size()) != Z_OK ||
        written != size)
        throw std::runtime_error("zlib finds damaged bytes");
    return bytes;
}

#else

std::optional<std::vector<std::byte>> deflate_bytes(std::span<const std::byte>) { return std::nullopt; }
std::vector<std::byte> inflate_bytes(std::span<const std::byte>, std::size_t) {
    throw std::runtime_error("there is no zlib");
}

#endif

std::vector<Way> all_ways(const Mesh& mesh) {
    std::vector<Way> ways;
#ifdef ESPALIER_BENCH_EMBREE
    add_embree_ways(ways, mesh);
#endif
#ifdef ESPALIER_BENCH_MESHOPT
    const Bytes file = write_meshopt(snap_mesh(mesh));
#ifdef ESPALIER_BENCH_EMBREE
    add_embree_meshopt_ways(ways, file);
#endif
    add_espalier_meshopt_ways(ways, file);
#endif
    add_espalier_ways(ways, mesh);
    return ways;
}

}  // namespace espalier::bench
