// espalier/c/scene.h: scenes of many instances.
#include <cstdint>

#include <runtime/c/abi.hpp>
#include <runtime/c/scene_arguments.hpp>

using namespace espalier;
using namespace espalier::detail;

namespace {

bool is_aligned(const void* place) { return reinterpret_cast<std::uintptr_t>(place) % alignof(Blob) == 0; }
static_assert(alignof(BakedScene) == alignof(Blob));

/// Returns options of C as C++ takes them, with a filter that outlives the call.
SceneSweepOptions cpp(const espalier_scene_sweep_options& options, const SceneFilter& filter) {
    SceneSweepOptions result;
    result.filter = filter;
    result.culling = static_cast<FaceCulling>(options.culling);
    result.ignore_leaving = options.ignore_leaving;
    result.skin = options.skin;
    return result;
}

}  // namespace

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
    const std::span<const Blob> meshes = cpp(scene).meshes();
    *count = meshes.size();
    return twin(meshes.data());
}
const espalier_scene* espalier_scene_tiles(const espalier_scene* scene, size_t* count) {
    const std::span<const BakedScene> tiles = cpp(scene).tiles();
    *count = tiles.size();
    return twin(tiles.data());
}
uint32_t espalier_scene_size(const espalier_scene* scene) { return cpp(scene).size(); }
float espalier_scene_max_error(const espalier_scene* scene) {
    return is_view(cpp(scene)) ? espalier::infinity : cpp(scene).max_error();
}
espalier_vec3d espalier_scene_source_origin(const espalier_scene* scene) { return c(cpp(scene).source_origin()); }
espalier_box espalier_scene_bounds(const espalier_scene* scene) { return c(cpp(scene).bounds()); }

espalier_lattice_result espalier_scene_common_lattice(const espalier_scene* scene) {
    return c(cpp(scene).common_lattice());
}

espalier_instance_result espalier_scene_instance_at(const espalier_scene* scene, espalier_instance_id instance) {
    return c(instance_at(cpp(scene), cpp(instance)));
}

espalier_mesh_result espalier_scene_mesh_at(const espalier_scene* scene, espalier_instance_id instance) {
    return c(espalier::mesh_at(cpp(scene), cpp(instance)));
}

espalier_yes_no espalier_scene_is_on_common_lattice(const espalier_scene* scene, espalier_instance_id instance) {
    return c(is_on_common_lattice(cpp(scene), cpp(instance)));
}

espalier_scene_ray_hit espalier_scene_raycast(const espalier_scene* scene, const espalier_ray* ray, uint32_t mask,
                                              espalier_scene_filter filter, void* user) {
    return c(raycast(cpp(scene), cpp(ray), Selection(mask, filter, user)));
}

espalier_scene_ray_hit espalier_scene_raycast_rounded(const espalier_scene* scene, const espalier_ray* ray,
                                                      const espalier_rounded_ray* rounded, uint32_t mask,
                                                      espalier_scene_filter filter, void* user) {
    return c(raycast(cpp(scene), cpp(ray), cpp(rounded), Selection(mask, filter, user)));
}

espalier_filled espalier_scene_raycast_batch(const espalier_scene* scene, const espalier_ray* rays,
                                             espalier_scene_ray_hit* hits, size_t count, uint32_t mask,
                                             espalier_scene_filter filter, void* user) {
    return c(raycast(cpp(scene), cpp(rays, count), cpp(hits, count), Selection(mask, filter, user)));
}

espalier_yes_no espalier_scene_occluded(const espalier_scene* scene, const espalier_ray* ray, uint32_t mask,
                                        espalier_scene_filter filter, void* user) {
    return c(occluded(cpp(scene), cpp(ray), Selection(mask, filter, user)));
}

espalier_yes_no espalier_scene_occluded_rounded(const espalier_scene* scene, const espalier_ray* ray,
                                                const espalier_rounded_ray* rounded, uint32_t mask,
                                                espalier_scene_filter filter, void* user) {
    return c(occluded(cpp(scene), cpp(ray), cpp(rounded), Selection(mask, filter, user)));
}

espalier_query_status espalier_scene_for_each_hit(const espalier_scene* scene, const espalier_ray* ray,
                                                  espalier_scene_hit_visitor visit, void* user, uint32_t mask,
                                                  espalier_scene_filter filter, void* filter_user) {
    if (visit == nullptr) return ESPALIER_QUERY_INVALID_ARGUMENT;
    return c(for_each_hit(cpp(scene), cpp(ray), visitor(visit, user), Selection(mask, filter, filter_user)));
}

espalier_query_status espalier_scene_for_each_hit_rounded(const espalier_scene* scene, const espalier_ray* ray,
                                                          const espalier_rounded_ray* rounded,
                                                          espalier_scene_hit_visitor visit, void* user, uint32_t mask,
                                                          espalier_scene_filter filter, void* filter_user) {
    if (visit == nullptr) return ESPALIER_QUERY_INVALID_ARGUMENT;
    return c(
        for_each_hit(cpp(scene), cpp(ray), cpp(rounded), visitor(visit, user), Selection(mask, filter, filter_user)));
}

espalier_scene_closest_point_result espalier_scene_closest_point(const espalier_scene* scene, espalier_vec3 point,
                                                                 float max_distance, uint32_t mask) {
    return c(closest_point(cpp(scene), cpp(point), max_distance, mask));
}

espalier_query_status espalier_scene_for_each_candidate(const espalier_scene* scene, const espalier_box* box,
                                                        espalier_instance_visitor visit, void* user, uint32_t mask) {
    if (visit == nullptr) return ESPALIER_QUERY_INVALID_ARGUMENT;
    return c(for_each_candidate(cpp(scene), cpp(box), visitor(visit, user), mask));
}

/// Defines the functions that sweep a shape.
#define SCENE_SWEEP(name)                                                                                           \
    espalier_scene_sweep_hit espalier_scene_sweep_##name(const espalier_scene* scene, const espalier_##name* shape, \
                                                         espalier_vec3 displacement, uint32_t mask,                 \
                                                         espalier_scene_filter filter, void* user) {                \
        return c(sweep(cpp(scene), cpp(shape), cpp(displacement), Selection(mask, filter, user)));                  \
    }                                                                                                               \
    espalier_scene_sweep_hit espalier_scene_sweep_##name##_with_options(                                            \
        const espalier_scene* scene, const espalier_##name* shape, espalier_vec3 displacement, uint32_t mask,       \
        const espalier_scene_sweep_options* options) {                                                              \
        const Selection selected(mask, options->filter, options->user);                                             \
        return c(sweep(cpp(scene), cpp(shape), cpp(displacement), cpp(*options, selected)));                        \
    }

SCENE_SWEEP(sphere)
SCENE_SWEEP(capsule)
SCENE_SWEEP(box)
SCENE_SWEEP(oriented_box)
SCENE_SWEEP(convex_hull)

/// Defines the functions that test and visit overlaps with a shape.
#define SCENE_OVERLAPS(name, Cpp)                                                                                     \
    espalier_yes_no espalier_scene_overlaps_##name(const espalier_scene* scene, const espalier_##name* shape,         \
                                                   uint32_t mask, espalier_scene_filter filter, void* user) {         \
        return c(overlaps(cpp(scene), cpp(shape), Selection(mask, filter, user)));                                    \
    }                                                                                                                 \
    espalier_query_status espalier_scene_for_each_overlap_##name(                                                     \
        const espalier_scene* scene, const espalier_##name* shape, espalier_scene_triangle_visitor visit, void* user, \
        uint32_t mask, espalier_scene_filter filter, void* filter_user) {                                             \
        if (visit == nullptr) return ESPALIER_QUERY_INVALID_ARGUMENT;                                                 \
        return c(                                                                                                     \
            for_each_overlap(cpp(scene), cpp(shape), visitor(visit, user), Selection(mask, filter, filter_user)));    \
    }

ESPALIER_SHAPES_(SCENE_OVERLAPS)
SCENE_OVERLAPS(triangle, Triangle)
