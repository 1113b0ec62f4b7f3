#include "plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <string_view>
#include <utility>

#include <espalier/format.hpp>

#include <import/base/importers.hpp>
#include <import/base/placement.hpp>

#include "layout/places.hpp"

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

/// A mesh whose vertices stand where its place puts them. Where float32 is too coarse for them they count from a
/// translation near their middle, which it holds.
Variant standing_in_place(const ImportResult& imported, std::uint32_t place, double largest_error) {
    const ImportedPlace& standing = imported.places[place];
    const ImportedMesh& mesh = imported.meshes[standing.mesh];
    Placement placement = standing.placement;
    PointBox box = box_at(mesh, placement);
    FittedTransform fitted;
    double farthest = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        farthest = std::max({farthest, std::abs(box.low[axis]), std::abs(box.high[axis])});
    if (std::isfinite(farthest) && farthest * 0x1p-24 > largest_error) {
        const Vec3 middle = importer::to_float32(Vec3d{
            0.5 * (box.low[0] + box.high[0]), 0.5 * (box.low[1] + box.high[1]), 0.5 * (box.low[2] + box.high[2])});
        fitted.transform.translation = middle;
        fitted.offset = importer::to_float64(middle);
        placement.offset[0] -= double(middle.x);
        placement.offset[1] -= double(middle.y);
        placement.offset[2] -= double(middle.z);
        box = box_at(mesh, placement);
    }
    return {standing.mesh, placement, box, {{place, fitted}}};
}

/// Whether a blob has the section once, however many triangles it has.
bool is_once(std::string_view section) {
    for (const std::string_view name : {"header", "guard", "oriented_box", "sphere", "k_dop", "source_origin"})
        if (section == name) return true;
    return false;
}

/// Of a mesh with that many bytes of its own. On average half of the alignment is padding.
double bytes_of_variant(double mesh, double instances) {
    constexpr double once =
        static_cast<double>(format::scene::alignment) / 2 + static_cast<double>(format::scene::part_size_bytes);
    constexpr double each = static_cast<double>(format::scene::instance_bytes) + format::packed_node::bytes / 4.0;
    return mesh + once + each * instances;
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

std::string words_for_place(const ImportResult& imported, const ImportedPlace& place) {
    const ImportedFile& file = imported.files.at(place.file);
    return words_for_mesh(file, place.number, file.mesh_names.at(place.number));
}

ImportedMesh placed_mesh(const ImportResult& imported, const ImportedPlace& place, const Placement& placement) {
    ImportedMesh mesh = imported.meshes.at(place.mesh);
    for (Vec3d& position : mesh.positions) position = placement(position);
    if (placement.mirrors())
        for (TriangleVertices& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    mesh.file = place.file;
    mesh.mesh = place.number;
    mesh.name = words_for_place(imported, place);
    return mesh;
}

ScenePlan plan_scene(const ImportResult& imported, Instancing instancing, double largest_error) {
    const std::vector<std::uint32_t> first = first_with_content(imported.meshes);
    std::map<std::uint32_t, std::vector<std::uint32_t>> places_of;  // by the first mesh with that content
    for (std::uint32_t i = 0; i < imported.places.size(); ++i) {
        const std::uint32_t mesh = imported.places[i].mesh;
        if (!imported.meshes[mesh].triangles.empty()) places_of[first[mesh]].push_back(i);
    }
    ScenePlan plan;
    const bool is_automatic = instancing == Instancing::automatic;
    for (const auto& [mesh, places] : places_of) {
        if (is_automatic && places.size() == 1) {
            plan.merged.push_back(places.front());
            continue;
        }
        VariantSorter sorter(imported, mesh, largest_error);
        for (const std::uint32_t place : places) {
            if (sorter.add(place)) continue;
            if (is_automatic) plan.merged.push_back(place);
            else plan.meshes.push_back(standing_in_place(imported, place, largest_error));
        }
        for (Variant& variant : sorter.variants()) {
            if (is_automatic && variant.uses.size() == 1) plan.merged.push_back(variant.uses.front().place);
            else plan.meshes.push_back(std::move(variant));
        }
    }
    std::sort(plan.merged.begin(), plan.merged.end());
    std::sort(plan.meshes.begin(), plan.meshes.end(),
              [](const Variant& a, const Variant& b) { return a.uses.front().place < b.uses.front().place; });
    return plan;
}

double bytes_as_part(std::span<const std::byte> bytes, const Blob& blob) {
    const Profile profile = blob.profile();
    const double children = format::max_node_children(profile);
    const double node_bytes = static_cast<double>(format::node_bytes(profile));
    double sum = 0.0;
    for (const Section& section : sections_of(blob)) {
        const auto own = static_cast<double>(section.bytes);
        if (std::string_view(section.name) == "nodes") {
            // Of full nodes there is one for all children but one.
            const double leaves = static_cast<double>(leaf_count(bytes, blob));
            sum += std::min(own, 1.25 * node_bytes * leaves / (children - 1.0));
        } else if (!is_once(section.name)) {
            sum += own;
        }
    }
    return sum;
}

double bytes_of_merging() {
    return bytes_of_variant(static_cast<double>(format::header::bytes + format::guard_bytes), 1.0);
}

double bytes_as_instances(const Blob& blob, std::uint64_t instances) {
    return bytes_of_variant(static_cast<double>(blob.size()), static_cast<double>(instances));
}

}  // namespace espalier::tools
