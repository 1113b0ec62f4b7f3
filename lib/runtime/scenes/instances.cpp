// What a scene returns of itself and of its instances.
#include <cstddef>
#include <cstdint>

#include <espalier/scene.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/scenes/instances.hpp>

namespace espalier {

using namespace detail;
using namespace format::scene;

Box BakedScene::bounds() const noexcept {
    if (data_.instance_count == 0) return {};
    const BlobData& tree = data_.tree;
    const float step = power_of_two(tree.step_exponent);
    const float* const o = tree.origin;
    const float* const e = tree.extent_steps;
    return {{o[0], o[1], o[2]}, {o[0] + e[0] * step, o[1] + e[1] * step, o[2] + e[2] * step}};
}

namespace {

/// The tile that an id leads through, or null if `in_tile` is none; and the record of the instance, or null for an id
/// that is out of range.
struct FoundInstance {
    const std::byte* outer = nullptr;
    const BakedScene* tile = nullptr;
    const std::byte* record = nullptr;
};

FoundInstance find_instance(const SceneData& scene, InstanceId id) {
    if (id.index >= scene.instance_count) return {};
    FoundInstance found;
    found.outer = found.record = record_of(scene, id);
    if (id.in_tile == no_instance.in_tile) return found;
    const std::uint32_t mesh = mesh_of(found.record);
    if (mesh < scene.mesh_count) return {};
    found.tile = scene.tiles + (mesh - scene.mesh_count);
    const SceneData& tile = data_of(*found.tile);
    found.record = id.in_tile < tile.instance_count ? record_of(tile, {id.in_tile}) : nullptr;
    return found;
}

/// Returns whether a ray that is rounded for the scene's common lattice meets the mesh or the tile of a record.
bool is_on_common_lattice(const SceneData& scene, const std::byte* record) {
    const Transform transform = transform_of(record);
    const std::uint32_t mesh = mesh_of(record);
    return mesh < scene.mesh_count
               ? detail::is_on_common_lattice(scene, scene.meshes[mesh], transform)
               : detail::is_on_common_lattice(scene, scene.tiles[mesh - scene.mesh_count], transform);
}

QueryStatus status_of(const BakedScene& scene, const FoundInstance& found) {
    return !scene ? QueryStatus::not_open : found.record == nullptr ? QueryStatus::invalid_argument : QueryStatus::ok;
}

}  // namespace

YesNo is_on_common_lattice(const BakedScene& scene, InstanceId instance) noexcept {
    const FoundInstance found = find_instance(data_of(scene), instance);
    const QueryStatus status = status_of(scene, found);
    if (status != QueryStatus::ok) return YesNo(status);
    const bool is_on = is_on_common_lattice(data_of(scene), found.outer);
    if (found.tile == nullptr) return YesNo::of(is_on);
    return YesNo::of(is_on && is_on_common_lattice(data_of(*found.tile), found.record));
}

Result<Instance> instance_at(const BakedScene& scene, InstanceId instance) noexcept {
    const FoundInstance found = find_instance(data_of(scene), instance);
    const QueryStatus status = status_of(scene, found);
    if (status != QueryStatus::ok) return {{}, status};
    const std::byte* const record = found.record;
    return {{transform_of(record), mesh_of(record), mask_of(record), load_u32(record + user_at),
             load_u32(record + source_at)},
            QueryStatus::ok};
}

Result<Blob> mesh_at(const BakedScene& scene, InstanceId instance) noexcept {
    const FoundInstance found = find_instance(data_of(scene), instance);
    const QueryStatus status = status_of(scene, found);
    if (status != QueryStatus::ok) return {{}, status};
    const SceneData& holder = found.tile != nullptr ? data_of(*found.tile) : data_of(scene);
    const std::uint32_t mesh = mesh_of(found.record);
    if (mesh >= holder.mesh_count) return {{}, QueryStatus::invalid_argument};
    return {holder.meshes[mesh], QueryStatus::ok};
}

}  // namespace espalier
