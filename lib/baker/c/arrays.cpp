#include <baker/c/arrays.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include <espalier/format.hpp>

#include <baker/c/structure.hpp>

namespace espalier::baker {

namespace {

constexpr std::uint64_t most_vertices = std::numeric_limits<std::uint32_t>::max();

SourcePlace place_of(const espalier_mesh_view& mesh) { return {mesh.file, mesh.mesh}; }

/// "level.obj, mesh 3" or "mesh 3 of the call".
std::string name_of(const espalier_mesh_view& mesh, std::size_t number) {
    if (mesh.name != nullptr && *mesh.name != '\0') return mesh.name;
    return "mesh " + std::to_string(number) + " of the call";
}

std::size_t coordinate_bytes(const espalier_mesh_view& mesh) {
    return mesh.coordinate_type == ESPALIER_COORDINATE_FLOAT64 ? sizeof(double) : sizeof(float);
}

std::size_t index_bytes(const espalier_mesh_view& mesh) {
    return mesh.index_type == ESPALIER_INDEX_UINT16 ? sizeof(std::uint16_t) : sizeof(std::uint32_t);
}

/// Returns what is wrong with an array of three numbers for each element; empty if nothing is.
std::string complaint_of(const char* name, const void* first, std::size_t count, std::ptrdiff_t stride,
                         std::size_t number_bytes) {
    if (count == 0) return {};
    if (first == nullptr) return std::string(name) + " is null, but has " + std::to_string(count) + " elements";
    const std::size_t length = stride < 0 ? std::size_t{0} - static_cast<std::size_t>(stride)
                                          : static_cast<std::size_t>(stride);  // of the least number too
    const std::size_t element = 3 * number_bytes;
    if (count > 1 && length < element)
        return std::string(name) + " has a stride of " + std::to_string(stride) +
               " bytes, but three numbers of this type take " + std::to_string(element) +
               "; give the bytes from one element to the next";
    constexpr auto most_bytes = static_cast<std::size_t>(std::numeric_limits<std::ptrdiff_t>::max());
    if (length > 0 && count > most_bytes / length)
        return std::string(name) + " has " + std::to_string(count) + " elements with a stride of " +
               std::to_string(stride) + " bytes, more than any memory holds; give the number of elements, not of bytes";
    return {};
}

/// Returns an element of an array.
const char* element_at(const void* first, std::ptrdiff_t stride, std::size_t number) {
    return static_cast<const char*>(first) + stride * static_cast<std::ptrdiff_t>(number);
}

/// Reads three numbers at any address.
template <class Number>
void read_three(const char* from, Number (&numbers)[3]) {
    std::memcpy(numbers, from, sizeof numbers);
}

template <class Index>
TriangleVertices triangle_at(const char* from) {
    Index indices[3];
    read_three(from, indices);
    return {indices[0], indices[1], indices[2]};
}

}  // namespace

espalier_mesh_view default_mesh_view() {
    espalier_mesh_view mesh = {};
    mesh.position_stride = 3 * sizeof(float);
    mesh.triangle_stride = 3 * sizeof(std::uint32_t);
    return mesh;
}

std::vector<Vec3> copy_vectors(const void* from, std::size_t count) {
    std::vector<Vec3> vectors(count);
    if (count != 0) std::memcpy(vectors.data(), from, count * sizeof(Vec3));
    return vectors;
}

std::optional<Failure> MeshArrays::read(const void* meshes, std::size_t count) {
    if (count == 0) return std::nullopt;
    if (meshes == nullptr)
        return Failure{ESPALIER_BAKE_INVALID_ARGUMENT,
                       "meshes is null, but mesh_count is " + std::to_string(count) + "; give an array of meshes"};
    std::size_t size = 0;
    std::memcpy(&size, meshes, sizeof size);
    std::vector<espalier_mesh_view> given;
    for (std::size_t i = 0; i < count; ++i) {
        espalier_mesh_view mesh = default_mesh_view();
        const char* const place = static_cast<const char*>(meshes) + i * size;
        const std::string name = "mesh " + std::to_string(i) + " of the call";
        constexpr std::size_t first_size = offsetof(espalier_mesh_view, index_type) + sizeof mesh.index_type;
        if (auto complaint = read_structure(place, first_size, name.c_str(), mesh))
            return Failure{ESPALIER_BAKE_INVALID_ARGUMENT, std::move(*complaint)};
        if (mesh.size != size)
            return Failure{ESPALIER_BAKE_INVALID_ARGUMENT, name + " has the size " + std::to_string(mesh.size) +
                                                               ", but the first one " + std::to_string(size) +
                                                               "; begin each with espalier_init_mesh_view"};
        given.push_back(mesh);
    }
    if (auto failure = check(given)) return failure;
    arrays_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        copy(given[i], arrays_[i]);
        views_.push_back({arrays_[i].positions, arrays_[i].triangles, arrays_[i].materials, given[i].file,
                          given[i].mesh, given[i].name == nullptr ? std::string() : std::string(given[i].name),
                          arrays_[i].float64_positions});
    }
    return std::nullopt;
}

std::size_t MeshArrays::position_count() const {
    std::size_t count = 0;
    for (const MeshView& view : views_) count += view.position_count();
    return count;
}

/// Refuses what cannot be read, and sizes that no blob can number, before anything is copied.
std::optional<Failure> MeshArrays::check(std::span<const espalier_mesh_view> meshes) const {
    std::uint64_t triangles = 0, vertices = 0;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const espalier_mesh_view& mesh = meshes[i];
        const auto refused = [&](espalier_bake_status status, const std::string& reason) {
            return Failure{status, name_of(mesh, i) + ": " + reason, place_of(mesh)};
        };
        if (mesh.coordinate_type > ESPALIER_COORDINATE_FLOAT64)
            return refused(ESPALIER_BAKE_INVALID_ARGUMENT,
                           "coordinate type " + std::to_string(mesh.coordinate_type) +
                               " does not exist; choose ESPALIER_COORDINATE_FLOAT32 or ESPALIER_COORDINATE_FLOAT64");
        if (mesh.index_type > ESPALIER_INDEX_UINT16)
            return refused(ESPALIER_BAKE_INVALID_ARGUMENT,
                           "index type " + std::to_string(mesh.index_type) +
                               " does not exist; choose ESPALIER_INDEX_UINT32 or ESPALIER_INDEX_UINT16");
        const std::string of_positions = complaint_of("positions", mesh.positions, mesh.position_count,
                                                      mesh.position_stride, coordinate_bytes(mesh));
        if (!of_positions.empty()) return refused(ESPALIER_BAKE_INVALID_ARGUMENT, of_positions);
        const std::string of_triangles =
            complaint_of("triangles", mesh.triangles, mesh.triangle_count, mesh.triangle_stride, index_bytes(mesh));
        if (!of_triangles.empty()) return refused(ESPALIER_BAKE_INVALID_ARGUMENT, of_triangles);
        const auto too_large = [&](std::uint64_t number, const char* of, std::uint64_t most) {
            return refused(ESPALIER_BAKE_TOO_LARGE, "with this mesh there are " + std::to_string(number) + of +
                                                        "; at most " + std::to_string(most) +
                                                        " can be baked at once; split the input into several blobs");
        };
        triangles += std::min<std::uint64_t>(mesh.triangle_count, std::uint64_t{1} << 62);
        vertices += std::min<std::uint64_t>(mesh.position_count, std::uint64_t{1} << 62);
        if (triangles > format::max_triangles) return too_large(triangles, " triangles", format::max_triangles);
        if (vertices > most_vertices) return too_large(vertices, " vertices", most_vertices);
    }
    return std::nullopt;
}

void MeshArrays::copy(const espalier_mesh_view& mesh, Arrays& arrays) {
    for (std::size_t i = 0; i < mesh.position_count; ++i) {
        const char* const place = element_at(mesh.positions, mesh.position_stride, i);
        if (mesh.coordinate_type == ESPALIER_COORDINATE_FLOAT64) {
            double position[3];
            read_three(place, position);
            arrays.float64_positions.push_back({position[0], position[1], position[2]});
        } else {
            float position[3];
            read_three(place, position);
            arrays.positions.push_back({position[0], position[1], position[2]});
        }
    }
    arrays.triangles.reserve(mesh.triangle_count);
    for (std::size_t i = 0; i < mesh.triangle_count; ++i) {
        const char* const indices = element_at(mesh.triangles, mesh.triangle_stride, i);
        arrays.triangles.push_back(mesh.index_type == ESPALIER_INDEX_UINT16 ? triangle_at<std::uint16_t>(indices)
                                                                            : triangle_at<std::uint32_t>(indices));
    }
    if (mesh.materials == nullptr || mesh.triangle_count == 0) return;
    arrays.materials.resize(mesh.triangle_count);
    std::memcpy(arrays.materials.data(), static_cast<const void*>(mesh.materials),
                mesh.triangle_count * sizeof(std::uint32_t));
}

}  // namespace espalier::baker
