// The records of instances, which are the leaves of the tree over them.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/scene.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/blob/node.hpp>
#include <runtime/lattice/region.hpp>

namespace espalier::detail {

/// A leaf of the tree: an instance.
using InstancePlace = LeafPlace<PackedNode>;

inline InstanceId instance_of(const InstancePlace& place) { return {place.node.leaf_block_place() + place.number}; }

/// Returns the record of an instance, whose number must be below the count.
inline const std::byte* record_of(const SceneData& scene, InstanceId instance) {
    return scene.tree.leaves + format::scene::instance_bytes * std::size_t{instance.index};
}

inline Transform transform_of(const std::byte* record) {
    using namespace format::scene;
    const auto number = [&](std::size_t at, std::size_t i) { return load_f32(record + at + 4 * i); };
    return {{number(rotation_at, 0), number(rotation_at, 1), number(rotation_at, 2), number(rotation_at, 3)},
            {number(translation_at, 0), number(translation_at, 1), number(translation_at, 2)},
            number(scale_at, 0)};
}

inline std::uint32_t mesh_of(const std::byte* record) { return load_u32(record + format::scene::mesh_at); }
inline std::uint32_t mask_of(const std::byte* record) { return load_u32(record + format::scene::mask_at); }

/// Returns why a scene that is not open refuses a query.
inline QueryStatus refusal_of(const SceneView& scene) {
    return data_of(scene).must_refit ? QueryStatus::not_refitted : QueryStatus::not_open;
}

/// A mesh or a tile, whichever an instance places; the other pointer is null.
struct MeshOrTile {
    const Blob* mesh;
    const BakedScene* tile;

    /// Returns what a query returns for the mesh or the tile.
    template <class Query>
    auto query(Query query) const {
        return mesh != nullptr ? query(*mesh) : query(*tile);
    }
};
/// Returns the mesh or the tile of a number.
inline MeshOrTile part_of(const SceneData& scene, std::uint32_t number) {
    if (number < scene.mesh_count) return {scene.meshes + number, nullptr};
    return {nullptr, scene.tiles + (number - scene.mesh_count)};
}
/// Returns the mesh or the tile of a record.
inline MeshOrTile part_of(const SceneData& scene, const std::byte* record) { return part_of(scene, mesh_of(record)); }

/// Returns whether what lies on a lattice of its own, at that place, lies in a region and on its lattice.
inline bool lies_in(const Lattice& region, const Lattice& lattice, const Transform& transform) {
    // mutant(never) work: find_in_region() tests it after the move
    if (lattice.step_exponent != region.step_exponent) return false;
    Lattice moved = region;
    std::int32_t steps[3] = {};
    return move_region(transform, moved) == QueryStatus::ok && find_in_region(lattice, moved, steps) == QueryStatus::ok;
}
inline bool lies_in(const Lattice& region, const Blob& mesh, const Transform& transform) {
    return mesh.triangle_count() != 0 && lies_in(region, mesh.lattice(), transform);
}
/// Returns the same for the common lattice of a tile; false if it has none.
inline bool lies_in(const Lattice& region, const BakedScene& tile, const Transform& transform) {
    return data_of(tile).has_common && lies_in(region, data_of(tile).common, transform);
}
inline bool lies_in(const Lattice& region, const MeshOrTile& part, const Transform& transform) {
    return part.query([&](const auto& mesh_or_tile) { return lies_in(region, mesh_or_tile, transform); });
}

}  // namespace espalier::detail
