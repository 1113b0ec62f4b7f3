#include "scenes.hpp"

#include <fstream>
#include <iterator>
#include <map>
#include <tuple>

namespace espalier::bench {

namespace {

std::vector<std::byte> read_bytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("cannot read '" + path + "'");
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    std::vector<std::byte> bytes(text.size());
    std::memcpy(bytes.data(), text.data(), text.size());
    return bytes;
}

/// Returns the triangles of a blob, with equal corners as one vertex.
Mesh mesh_of(const Blob& blob) {
    Mesh mesh;
    std::map<std::tuple<float, float, float>, std::uint32_t> vertices;
    const auto vertex = [&](const Vec3& p) {
        const auto number = static_cast<std::uint32_t>(mesh.positions.size());
        const auto [found, is_new] = vertices.try_emplace({p.x, p.y, p.z}, number);
        if (is_new) mesh.positions.push_back(p);
        return found->second;
    };
    for (std::uint32_t i = 0; i < blob.triangle_count(); ++i) {
        const Result<Triangle> triangle = triangle_at(blob, TriangleId{i});
        mesh.triangles.push_back({vertex(triangle->a), vertex(triangle->b), vertex(triangle->c)});
    }
    return mesh;
}

}  // namespace

SceneFile::SceneFile(const std::string& path) : bytes(read_bytes(path)) {
    std::vector<Blob> meshes(mesh_count_of_scene(bytes));
    if (tile_count_of_scene(bytes) != 0) throw std::runtime_error("'" + path + "' has tiles: it is not measured");
    const BakedScene scene = open_scene(bytes, meshes);
    if (!scene) throw std::runtime_error("'" + path + "': " + describe(scene.status()));
    for (const Blob& blob : meshes) placed.meshes.push_back(mesh_of(blob));
    for (std::uint32_t i = 0; i < scene.instance_count(); ++i)
        placed.instances.push_back(*instance_at(scene, InstanceId{i}));
}

Mesh SceneFile::flattened() const {
    Mesh mesh;
    for (const Instance& instance : placed.instances) {
        const Mesh& part = placed.meshes[instance.mesh];
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const Vec3& p : part.positions) mesh.positions.push_back(to_world(instance.transform, p));
        for (const TriangleVertices& t : part.triangles)
            mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    return mesh;
}

}  // namespace espalier::bench
