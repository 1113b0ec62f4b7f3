#include "baking.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <utility>

#include "files/outputs.hpp"

namespace espalier::tools {

namespace {

std::string depfile_of(const BakeArguments& arguments, const ImportResult& imported,
                       std::span<const ImportedFile> poses) {
    std::vector<std::string> sources;
    for (const std::span<const ImportedFile> files : {std::span<const ImportedFile>(imported.files), poses}) {
        for (const ImportedFile& file : files) sources.insert(sources.end(), file.opened.begin(), file.opened.end());
    }
    if (!arguments.lattice_of.empty() && arguments.lattice_of != "-") sources.push_back(arguments.lattice_of);
    return depfile_text(arguments.output, sources);
}

bool is_ply(const std::string& path) { return path.ends_with(".ply"); }

void put_text(std::vector<std::byte>& bytes, const std::string& words) {
    const auto added = std::as_bytes(std::span(words));
    bytes.insert(bytes.end(), added.begin(), added.end());
}

template <class Unsigned>
void put_unsigned(std::vector<std::byte>& bytes, Unsigned value) {
    for (unsigned shift = 0; shift < 8 * sizeof(Unsigned); shift += 8)
        bytes.push_back(static_cast<std::byte>(value >> shift));
}

bool is_float32(const Vec3d& point) { return to_float64(to_float32(point)) == point; }

/// The source's triangles in the blob's order, and the vertices that they use, in the order of their first use.
struct Reordered {
    std::vector<Vec3d> positions;
    std::vector<TriangleVertices> triangles;
};

Reordered reordered(const ImportResult& imported, std::span<const OriginalTriangle> remap) {
    struct Place {
        const ImportedMesh* mesh;
        std::size_t first_vertex;
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, Place> places;
    std::size_t vertices = 0;
    for (const ImportedMesh& mesh : imported.meshes) {
        places[{mesh.file, mesh.mesh}] = {&mesh, vertices};
        vertices += mesh.positions.size();
    }
    constexpr std::uint32_t unused = ~std::uint32_t{0};
    std::vector<std::uint32_t> numbers(vertices, unused);
    Reordered result;
    for (const OriginalTriangle& original : remap) {
        const Place& place = places.at({original.file, original.mesh});
        const TriangleVertices& source = place.mesh->triangles[original.triangle];
        TriangleVertices& triangle = result.triangles.emplace_back();
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = source[(original.first_corner + corner) % 3];
            std::uint32_t& number = numbers[place.first_vertex + vertex];
            if (number == unused) {
                number = static_cast<std::uint32_t>(result.positions.size());
                result.positions.push_back(place.mesh->positions[vertex]);
            }
            triangle[corner] = number;
        }
    }
    return result;
}

}  // namespace

// The depfile is renamed before the result: were it the other way round and the second failed, a change of a file that
// is new to the list would go unnoticed.
void write_outputs(const BakeArguments& arguments, const ImportResult& imported, std::span<const ImportedFile> poses,
                   const BakeOutputs& outputs) {
    const std::string rule = arguments.depfile.empty() ? std::string() : depfile_of(arguments, imported, poses);
    OutputFiles files;
    if (!arguments.depfile.empty()) files.add(arguments.depfile, std::as_bytes(std::span(rule)));
    if (!arguments.remap.empty()) files.add(arguments.remap, outputs.remap);
    if (!arguments.reorder.empty()) files.add(arguments.reorder, outputs.reordered);
    files.add(arguments.output, outputs.result);
    files.commit();
}

void require_writable_mesh(const std::string& path) {
    if (path.empty() || is_ply(path) || path.ends_with(".obj")) return;
    throw_error(ExitCode::usage, "--reorder ", printable(path), ": the name must end in .obj or .ply.");
}

std::vector<std::byte> reordered_mesh(const std::string& path, const ImportResult& imported,
                                      std::span<const OriginalTriangle> remap) {
    const auto [positions, triangles] = reordered(imported, remap);
    const bool are_float32 = std::all_of(positions.begin(), positions.end(), is_float32);
    const char* const type = are_float32 ? "float" : "double";
    std::vector<std::byte> bytes;
    if (is_ply(path)) {
        put_text(bytes,
                 text("ply\nformat binary_little_endian 1.0\ncomment in the order of an Espalier blob\nelement vertex ",
                      positions.size(), "\nproperty ", type, " x\nproperty ", type, " y\nproperty ", type,
                      " z\nelement face ", triangles.size(), "\nproperty list uchar int vertex_indices\nend_header\n"));
    } else {
        put_text(bytes, "# in the order of an Espalier blob\n");
    }
    for (const Vec3d& position : positions) {
        if (!is_ply(path)) {
            put_text(bytes, are_float32 ? text("v ", shortest(to_float32(position)), '\n')
                                        : text("v ", position.x, ' ', position.y, ' ', position.z, '\n'));
            continue;
        }
        for (const double coordinate : {position.x, position.y, position.z}) {
            if (are_float32) put_unsigned(bytes, std::bit_cast<std::uint32_t>(to_float32(coordinate)));
            else put_unsigned(bytes, std::bit_cast<std::uint64_t>(coordinate));
        }
    }
    for (const TriangleVertices& triangle : triangles) {
        if (is_ply(path)) {
            bytes.push_back(std::byte{3});
            for (const std::uint32_t vertex : triangle) put_unsigned(bytes, vertex);
        } else {
            put_text(bytes, text("f ", triangle[0] + 1, ' ', triangle[1] + 1, ' ', triangle[2] + 1, '\n'));
        }
    }
    return bytes;
}

}  // namespace espalier::tools
