// espalier/c/scene.h: scenes of many instances.
#include <runtime/c/abi.hpp>
#include <runtime/c/scene_arguments.hpp>

using namespace espalier;
using namespace espalier::detail;

uint32_t espalier_scene_mesh_count(const void* bytes, size_t size) { return mesh_count_of_scene(cpp(bytes, size)); }
uint32_t espalier_scene_tile_count(const void* bytes, size_t size) { return tile_count_of_scene(cpp(bytes, size)); }

espalier_open_status espalier_open_scene(const void* bytes, size_t size, espalier_blob* meshes, size_t mesh_capacity,
                                         espalier_scene* tiles, size_t tile_capacity, espalier_scene* scene) {
    if (!is_aligned(scene) || !is_aligned(meshes) || !is_aligned(tiles)) return ESPALIER_OPEN_MISALIGNED;
    for (std::size_t i = 0; i < mesh_capacity; ++i) meshes[i] = c(Blob());
    for (std::size_t i = 0; i < tile_capacity; ++i) tiles[i] = c(BakedScene());
    *scene = c(open_scene(cpp(bytes, size), cpp(meshes, mesh_capacity), cpp(tiles, tile_capacity)));
    return c(cpp(scene).status());
}

espalier_open_status espalier_scene_status(const espalier_scene* scene) { return c(cpp(scene).status()); }
uint32_t espalier_scene_instance_count(const espalier_scene* scene) { return cpp(scene).instance_count(); }
const espalier_blob* espalier_scene_meshes(const espalier_scene* scene, size_t* count) {
    return elements(cpp(scene).meshes(), count);
}
const espalier_scene* espalier_scene_tiles(const espalier_scene* scene, size_t* count) {
    return elements(cpp(scene).tiles(), count);
}
uint32_t espalier_scene_size(const espalier_scene* scene) { return cpp(scene).size(); }
ESPALIER_C_FUNCTION(espalier_scene_max_error, (scene),
                    is_view(cpp(scene)) ? espalier::infinity : cpp(scene).max_error())
espalier_vec3d espalier_scene_source_origin(const espalier_scene* scene) { return c(cpp(scene).source_origin()); }
espalier_box espalier_scene_bounds(const espalier_scene* scene) { return c(cpp(scene).bounds()); }

ESPALIER_C_FUNCTION(espalier_scene_common_lattice, (scene), c(cpp(scene).common_lattice()))

ESPALIER_C_FUNCTION(espalier_scene_instance_at, (scene, instance), c(instance_at(cpp(scene), cpp(instance))))

ESPALIER_C_FUNCTION(espalier_scene_mesh_at, (scene, instance), c(espalier::mesh_at(cpp(scene), cpp(instance))))

ESPALIER_C_FUNCTION(espalier_scene_is_on_common_lattice, (scene, instance),
                    c(is_on_common_lattice(cpp(scene), cpp(instance))))

ESPALIER_C_FUNCTION(espalier_scene_raycast, (scene, ray, mask, filter, user),
                    c(raycast(cpp(scene), cpp(ray), Selection(mask, filter, user))))

ESPALIER_C_FUNCTION(espalier_scene_raycast_rounded, (scene, ray, rounded, mask, filter, user),
                    c(raycast(cpp(scene), cpp(ray), cpp(rounded), Selection(mask, filter, user))))

ESPALIER_C_FUNCTION(espalier_scene_raycast_batch, (scene, rays, hits, count, mask, filter, user),
                    c(raycast(cpp(scene), cpp(rays, count), cpp(hits, count), Selection(mask, filter, user))))

ESPALIER_C_FUNCTION(espalier_scene_occluded, (scene, ray, mask, filter, user),
                    c(occluded(cpp(scene), cpp(ray), Selection(mask, filter, user))))

ESPALIER_C_FUNCTION(espalier_scene_occluded_rounded, (scene, ray, rounded, mask, filter, user),
                    c(occluded(cpp(scene), cpp(ray), cpp(rounded), Selection(mask, filter, user))))

ESPALIER_C_VISITING(espalier_scene_for_each_hit, (scene, ray, visit, user, mask, filter, filter_user),
                    c(for_each_hit(cpp(scene), cpp(ray), visitor(visit, user), Selection(mask, filter, filter_user))))

ESPALIER_C_VISITING(espalier_scene_for_each_hit_rounded, (scene, ray, rounded, visit, user, mask, filter, filter_user),
                    c(for_each_hit(cpp(scene), cpp(ray), cpp(rounded), visitor(visit, user),
                                   Selection(mask, filter, filter_user))))

ESPALIER_C_FUNCTION(espalier_scene_closest_point, (scene, point, max_distance, mask),
                    c(closest_point(cpp(scene), cpp(point), max_distance, mask)))

ESPALIER_C_VISITING(espalier_scene_for_each_candidate, (scene, box, visit, user, mask),
                    c(for_each_candidate(cpp(scene), cpp(box), visitor(visit, user), mask)))

/// Defines the functions that sweep a shape.
#define SCENE_SWEEP(name)                                                                                   \
    ESPALIER_C_FUNCTION(espalier_scene_sweep_##name, (scene, shape, displacement, mask, filter, user),      \
                        c(sweep(cpp(scene), cpp(shape), cpp(displacement), Selection(mask, filter, user)))) \
    ESPALIER_C_FUNCTION(                                                                                    \
        espalier_scene_sweep_##name##_with_options, (scene, shape, displacement, mask, options),            \
        c(sweep(cpp(scene), cpp(shape), cpp(displacement),                                                  \
                sweep_options<SceneSweepOptions>(*options, Selection(mask, options->filter, options->user)))))

ESPALIER_C_SWEPT_SHAPES(SCENE_SWEEP)

/// Defines the functions that test and visit overlaps with a shape.
#define SCENE_OVERLAPS(name, Cpp)                                                                       \
    ESPALIER_C_FUNCTION(espalier_scene_overlaps_##name, (scene, shape, mask, filter, user),             \
                        c(overlaps(cpp(scene), cpp(shape), Selection(mask, filter, user))))             \
    ESPALIER_C_VISITING(                                                                                \
        espalier_scene_for_each_overlap_##name, (scene, shape, visit, user, mask, filter, filter_user), \
        c(for_each_overlap(cpp(scene), cpp(shape), visitor(visit, user), Selection(mask, filter, filter_user))))

ESPALIER_SHAPES_(SCENE_OVERLAPS)
SCENE_OVERLAPS(triangle, Triangle)
