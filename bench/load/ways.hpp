// What a game or an editor may ship of a mesh: floats, or the streams of meshoptimizer.
#pragma once

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

using ReadMesh = void (*)(std::span<const std::byte> file, const MeshArrays& to);
[[nodiscard]] Mesh decoded(std::span<const std::byte> file, ReadMesh read);

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

// A general compressor on top: zlib, where it is installed.

/// Returns the bytes compressed at zlib's highest level, or nothing without zlib.
[[nodiscard]] std::optional<std::vector<std::byte>> deflate_bytes(std::span<const std::byte> bytes);
/// Returns the `size` bytes that were compressed. Throws std::runtime_error for damaged ones.
[[nodiscard]] std::vector<std::byte> inflate_bytes(std::span<const std::byte> compressed, std::size_t size);

// The memory that something takes at most.

/// Returns how many bytes of memory a process gets from the system at most while it runs `work`, beyond those that it
/// has before; pages of files that `work` maps are among them. A child process runs `work` twice and counts the second
/// time: by then the program's own pages are there. `work` must free what it takes. Nothing where it is less than half
/// a megabyte, which Linux does not count exactly, where the system counts nothing, or where the child fails.
///
/// Call it before a library starts threads, which a child does not have.
[[nodiscard]] std::optional<std::size_t> peak_memory(const std::function<void()>& work);

// Ways from bytes on disk to the first answer: what is shipped, and what happens to it at load.

/// What answers rays after a load.
class Loaded {
public:
    Loaded() = default;
    Loaded(const Loaded&) = delete;
    Loaded& operator=(const Loaded&) = delete;
    virtual ~Loaded() = default;
    /// Returns t of the closest hit, or infinity.
    [[nodiscard]] virtual float closest(const Ray& ray) const = 0;
    /// Returns the bytes that queries read and that must stay.
    [[nodiscard]] virtual std::size_t bytes() const = 0;
};

struct Way {
    std::string ships;  ///< what is on disk
    std::string loads;  ///< what happens to it
    Bytes file;
    /// Loads from memory, or from the disk if the file is mapped.
    std::function<std::unique_ptr<Loaded>(std::span<const std::byte> file)> load;
    bool is_mapped = false;  ///< the file is not in memory before
};

// Each appends to the ways. Files are made from the mesh; what meshoptimizer ships, and the blobs, are of 16 bits.
void add_embree_ways(std::vector<Way>& ways, const Mesh& mesh);           ///< where Embree is installed
void add_embree_meshopt_ways(std::vector<Way>& ways, const Bytes& file);  ///< with meshoptimizer too
void add_espalier_ways(std::vector<Way>& ways, const Mesh& mesh);
void add_espalier_meshopt_ways(std::vector<Way>& ways, const Bytes& file);

/// Returns all that this build has. The first is the reference: floats, and Embree's default build.
[[nodiscard]] std::vector<Way> all_ways(const Mesh& mesh);

}  // namespace espalier::bench
