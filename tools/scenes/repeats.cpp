#include "repeats.hpp"

#include <cstddef>
#include <cstring>
#include <map>
#include <span>
#include <utility>

namespace espalier::tools {

namespace {

/// A number for bytes, the same on every machine of one byte order (FNV-1a over 64 bits).
class ContentHash {
public:
    template <class Element>
    void add(const std::vector<Element>& elements) {
        add_number(elements.size());
        for (const std::byte byte : std::as_bytes(std::span(elements))) mix(std::to_integer<std::uint64_t>(byte));
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

private:
    void add_number(std::uint64_t number) {
        for (unsigned i = 0; i < 8; ++i) mix(number >> 8 * i & 0xFF);
    }
    void mix(std::uint64_t byte) { value_ = (value_ ^ byte) * 0x100000001B3u; }

    std::uint64_t value_ = 0xCBF29CE484222325u;
};

std::uint64_t hash_of(const ImportedMesh& mesh) {
    ContentHash hash;
    hash.add(mesh.positions);
    hash.add(mesh.triangles);
    hash.add(mesh.materials);
    return hash.value();
}

template <class Element>
bool same_bytes(const std::vector<Element>& a, const std::vector<Element>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Element)) == 0);
}

bool same_content(const ImportedMesh& a, const ImportedMesh& b) {
    return same_bytes(a.positions, b.positions) && same_bytes(a.triangles, b.triangles) &&
           same_bytes(a.materials, b.materials);
}

}  // namespace

std::vector<std::uint32_t> first_with_content(const std::vector<ImportedMesh>& meshes) {
    std::vector<std::uint32_t> first(meshes.size());
    std::map<std::uint64_t, std::vector<std::uint32_t>> of_hash;
    for (std::uint32_t i = 0; i < meshes.size(); ++i) {
        first[i] = i;
        std::vector<std::uint32_t>& candidates = of_hash[hash_of(meshes[i])];
        for (const std::uint32_t candidate : candidates) {
            if (!same_content(meshes[candidate], meshes[i])) continue;
            first[i] = candidate;
            break;
        }
        if (first[i] == i) candidates.push_back(i);
    }
    return first;
}

std::string words_for_place(const Imported& imported, const ImportedPlace& place) {
    const ImportedFile& file = imported.files.at(place.file);
    return words_for_mesh(file, place.number, file.mesh_names.at(place.number));
}

ImportedMesh placed_mesh(const Imported& imported, const ImportedPlace& place, const Placement& placement) {
    ImportedMesh mesh = imported.meshes.at(place.mesh);
    for (Vec3& position : mesh.positions) position = placement(position);
    if (placement.mirrors())
        for (TriangleVertices& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    mesh.file = place.file;
    mesh.mesh = place.number;
    mesh.name = words_for_place(imported, place);
    return mesh;
}

}  // namespace espalier::tools
