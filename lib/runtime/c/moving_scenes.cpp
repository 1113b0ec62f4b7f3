// espalier/c/scenes/moving_scene.h: scenes whose instances move.
#include <bit>

#include <runtime/c/abi.hpp>
#include <runtime/c/scene_arguments.hpp>

using namespace espalier;
using namespace espalier::detail;

namespace {

/// Writes the scene that `make` returns for memory, meshes and tiles. Returns whether it is open.
template <class Make>
bool make_scene(void* memory, std::size_t size, const espalier_blob* meshes, std::size_t mesh_count,
                const espalier_scene* tiles, std::size_t tile_count, espalier_moving_scene* scene, Make make) {
    if (!is_aligned(scene)) return false;
    *scene = c(MovingScene());
    for (std::size_t i = 0; i < tile_count; ++i)
        if (is_view(cpp(tiles[i]))) return false;
    *scene = c(make(std::span(static_cast<std::byte*>(memory), size), cpp(meshes, mesh_count), cpp(tiles, tile_count)));
    return static_cast<bool>(cpp(scene));
}

}  // namespace

uint64_t espalier_moving_scene_bytes(uint32_t instances) { return moving_scene_bytes(instances); }
uint64_t espalier_least_moving_scene_bytes(uint32_t instances) { return least_moving_scene_bytes(instances); }

ESPALIER_C_FUNCTION(espalier_create_moving_scene,
                    (memory, size, capacity, step_exponent, meshes, mesh_count, tiles, tile_count, scene),
                    make_scene(memory, size, meshes, mesh_count, tiles, tile_count, scene,
                               [&](auto block, auto cpp_meshes, auto cpp_tiles) {
                                   return create_moving_scene(block, capacity, step_exponent, cpp_meshes, cpp_tiles);
                               }))

ESPALIER_C_FUNCTION(espalier_open_moving_scene, (snapshot, size, meshes, mesh_count, tiles, tile_count, scene),
                    make_scene(snapshot, size, meshes, mesh_count, tiles, tile_count, scene,
                               [](auto block, auto cpp_meshes, auto cpp_tiles) {
                                   return open_moving_scene(block, cpp_meshes, cpp_tiles);
                               }))

bool espalier_moving_scene_is_open(const espalier_moving_scene* scene) { return static_cast<bool>(cpp(scene)); }
ESPALIER_C_FUNCTION(espalier_moving_scene_instance_count, (scene), cpp(scene).instance_count())
uint32_t espalier_moving_scene_capacity(const espalier_moving_scene* scene) { return cpp(scene).capacity(); }
uint32_t espalier_moving_scene_slot_end(const espalier_moving_scene* scene) { return cpp(scene).slot_end(); }
int espalier_moving_scene_step_exponent(const espalier_moving_scene* scene) { return cpp(scene).step_exponent(); }
espalier_vec3d espalier_moving_scene_origin(const espalier_moving_scene* scene) { return c(cpp(scene).origin()); }
ESPALIER_C_FUNCTION(espalier_moving_scene_common_lattice, (scene), c(cpp(scene).common_lattice()))
bool espalier_moving_scene_must_refit(const espalier_moving_scene* scene) { return cpp(scene).must_refit(); }
const void* espalier_moving_scene_block(const espalier_moving_scene* scene, size_t* size) {
    const std::span<const std::byte> bytes = cpp(scene).bytes();
    *size = bytes.size();
    return bytes.data();
}
const espalier_blob* espalier_moving_scene_meshes(const espalier_moving_scene* scene, size_t* count) {
    return elements(cpp(scene).meshes(), count);
}
const espalier_scene* espalier_moving_scene_tiles(const espalier_moving_scene* scene, size_t* count) {
    return elements(cpp(scene).tiles(), count);
}

bool espalier_moving_scene_seen_from(const espalier_moving_scene* scene, espalier_vec3d place,
                                     espalier_moving_scene* view) {
    if (!is_aligned(view)) return false;
    *view = c(seen_from(cpp(scene), cpp(place)));
    return static_cast<bool>(cpp(view));
}

ESPALIER_C_FUNCTION(espalier_moving_scene_insert, (scene, instance), c(insert(cpp(scene), cpp(instance))))

ESPALIER_C_FUNCTION(espalier_moving_scene_remove, (scene, instance), c(remove(cpp(scene), cpp(instance))))

ESPALIER_C_FUNCTION(espalier_moving_scene_move, (scene, instance, transform),
                    c(move(cpp(scene), cpp(instance), cpp(transform))))

ESPALIER_C_FUNCTION(espalier_moving_scene_move_batch, (scene, movements, count),
                    c(move(cpp(scene), cpp(movements, count))))

ESPALIER_C_FUNCTION(espalier_moving_scene_move_instances_of, (scene, mesh), c(move_instances_of(cpp(scene), mesh)))

ESPALIER_C_FUNCTION(espalier_moving_scene_set_mask, (scene, instance, mask),
                    c(set_mask(cpp(scene), cpp(instance), mask)))

ESPALIER_C_FUNCTION(espalier_moving_scene_set_user, (scene, instance, user),
                    c(set_user(cpp(scene), cpp(instance), user)))

uint32_t espalier_moving_scene_refit(espalier_moving_scene* scene) { return refit(cpp(scene)); }
void espalier_moving_scene_repack(espalier_moving_scene* scene) { repack(cpp(scene)); }
float espalier_moving_scene_quality(const espalier_moving_scene* scene) { return quality(cpp(scene)); }
void espalier_moving_scene_end_step(espalier_moving_scene* scene) { end_step(cpp(scene)); }

ESPALIER_C_FUNCTION(espalier_moving_scene_handle_of, (scene, slot), c(handle_of(cpp(scene), slot)))

ESPALIER_C_FUNCTION(espalier_moving_scene_instance_at, (scene, instance), c(instance_at(cpp(scene), cpp(instance))))

ESPALIER_C_FUNCTION(espalier_moving_scene_instance_of_id, (scene, instance), c(instance_at(cpp(scene), cpp(instance))))

ESPALIER_C_FUNCTION(espalier_moving_scene_is_on_common_lattice, (scene, instance),
                    c(is_on_common_lattice(cpp(scene), cpp(instance))))

ESPALIER_C_FUNCTION(espalier_moving_scene_box_of, (scene, instance), c(box_of(cpp(scene), cpp(instance))))

espalier_query_status espalier_moving_scene_view(const espalier_moving_scene* scene, espalier_scene* view) {
    if (!is_aligned(view)) return ESPALIER_QUERY_INVALID_ARGUMENT;
    static_assert(sizeof(SceneView) == sizeof(BakedScene));  // C has one structure for both
    *view = std::bit_cast<espalier_scene>(static_cast<SceneView>(cpp(scene)));
    if (!cpp(scene)) return ESPALIER_QUERY_NOT_OPEN;
    return cpp(scene).must_refit() ? ESPALIER_QUERY_NOT_REFITTED : ESPALIER_QUERY_OK;
}
