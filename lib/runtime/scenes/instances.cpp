// What a scene returns of itself and of its instances.
#include <runtime/blob/source_origin.hpp>
#include <runtime/lattice/to_local.hpp>
#include <runtime/scenes/instances.hpp>

namespace espalier {

using namespace detail;
using namespace format::scene;

Box SceneView::bounds() const noexcept {
    if (data_.instance_count == 0) return {};
    const BlobData& tree = data_.tree;
    const float* const extent = tree.extent_steps;  // a MovingScene has no other
    return {{tree.origin[0], tree.origin[1], tree.origin[2]}, to_local(tree, extent[0], extent[1], extent[2])};
}

Vec3d BakedScene::source_origin() const noexcept {
    // C passes views of moving scenes too, which have the bytes of a block.
    if (data_.tree.bytes == nullptr || data_.moving != nullptr ||
        (load_u32(data_.tree.bytes + features_at) & has_source_origin) == 0)
        return {};
    return load_source_origin(data_.tree.bytes + source_origin_at);
}

namespace {

/// What an id leads to.
struct FoundInstance {
    QueryStatus status = QueryStatus::invalid_argument;  ///< else ok or not_open
    const std::byte* outer = nullptr;                    ///< the record of the instance, or of the tile that it is in
    const SceneData* holder = nullptr;                   ///< the scene, or the tile
    const std::byte* record = nullptr;                   ///< in the holder
};

FoundInstance find_instance(const BakedScene& scene, InstanceId id) {
    if (!scene) return {QueryStatus::not_open};
    const SceneData& all = data_of(scene);
    if (all.moving != nullptr) return {};  // C passes views of moving scenes too, whose instances have no records
    if (id.index >= all.instance_count) return {};
    const std::byte* const outer = record_of(all, id);
    if (id.in_tile == no_instance.in_tile) return {QueryStatus::ok, outer, &all, outer};
    const BakedScene* const tile = part_of(all, outer).tile;
    if (tile == nullptr || id.in_tile >= tile->instance_count()) return {};
    return {QueryStatus::ok, outer, &data_of(*tile), record_of(data_of(*tile), {id.in_tile})};
}

/// Returns whether the mesh or the tile of a record lies in a region and on its lattice.
bool part_lies_in(const Lattice& region, const SceneData& holder, const std::byte* record) {
    return lies_in(region, part_of(holder, record), transform_of(record));
}

}  // namespace

YesNo is_on_common_lattice(const BakedScene& scene, InstanceId instance) noexcept {
    const FoundInstance found = find_instance(scene, instance);
    if (found.status != QueryStatus::ok) return YesNo(found.status);
    const SceneData& data = data_of(scene);
    // mutant(without 1) equivalent: in a region without extent lies nothing
    if (!data.has_common || !part_lies_in(data.common, data, found.outer)) return YesNo::of(false);
    if (found.record == found.outer) return YesNo::of(true);
    Lattice in_tile = data.common;
    // mutant(== -> true, without 1) equivalent: the tile lies in the region, so that the same move was possible before
    return YesNo::of(move_region(transform_of(found.outer), in_tile) == QueryStatus::ok &&
                     part_lies_in(in_tile, *found.holder, found.record));
}

Result<Instance> instance_at(const BakedScene& scene, InstanceId instance) noexcept {
    const FoundInstance found = find_instance(scene, instance);
    if (found.status != QueryStatus::ok) return {{}, found.status};
    const std::byte* const record = found.record;
    return {{transform_of(record), mesh_of(record), mask_of(record), load_u32(record + user_at),
             load_u32(record + source_at)},
            QueryStatus::ok};
}

Result<Blob> mesh_at(const BakedScene& scene, InstanceId instance) noexcept {
    const FoundInstance found = find_instance(scene, instance);
    if (found.status != QueryStatus::ok) return {{}, found.status};
    const Blob* const mesh = part_of(*found.holder, found.record).mesh;
    if (mesh == nullptr) return {{}, QueryStatus::invalid_argument};
    return {*mesh, QueryStatus::ok};
}

}  // namespace espalier
