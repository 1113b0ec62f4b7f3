// Batches over a scene, baked or the view of a moving one: one call of the functions of C for each query.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <espalier/c/batches/arrays.h>
#include <espalier/c/scene.h>
#include <espalier/c/scenes/contacts.h>

#include "lists.hpp"
#include "scene_records.hpp"

namespace {

bool keeps_instance(espalier_instance_id instance, espalier_triangle_id, void* user) {
    return espalier::wasm::has_flag(*static_cast<const espalier_flags*>(user), instance.index);
}

espalier_scene_filter filter_of(const espalier_scene_selection& selection) {
    return selection.only == nullptr ? nullptr : keeps_instance;
}

/// Returns options that keep the instances with a flag.
espalier_scene_sweep_options with_flags(espalier_scene_sweep_options options,
                                        const espalier_scene_selection& selection) {
    options.filter = filter_of(selection);
    options.user = selection.only;
    return options;
}

/// Writes a list for each query, where list(i, room) adds its elements. Of a moving scene it sorts each by slot, and
/// keeps nothing of a refused query: what was visited until then depends on the tree.
template <class Item, class List>
espalier_filled_lists collect(std::size_t count, const espalier::wasm::ListArrays<Item>& to,
                              const espalier_scene_selection& selection, const List& list) {
    return espalier::wasm::collect_lists<Item>(count, to, [&](std::size_t i, espalier::wasm::Room<Item>& room) {
        const espalier_query_status status = list(i, room);
        if (!selection.sorts) return status;
        if (espalier_is_refused(status)) room.added = 0;
        if (room.added <= room.capacity)
            std::stable_sort(room.places, room.places + room.added,
                             [](const Item& a, const Item& b) { return a.instance.index < b.instance.index; });
        return status;
    });
}

espalier_visit add_hit(espalier_instance_id instance, const espalier_ray_hit* hit, void* user) {
    const espalier_scene_ray_hit item = {*hit, instance};
    return espalier::wasm::add_to_room(&item, user);
}

espalier_visit add_triangle(espalier_instance_id instance, espalier_triangle_id triangle, void* user) {
    const espalier_scene_triangle item = {instance, triangle};
    return espalier::wasm::add_to_room(&item, user);
}

espalier_visit add_candidate(espalier_instance_id instance, void* user) {
    const espalier_scene_candidate item = {instance};
    return espalier::wasm::add_to_room(&item, user);
}

}  // namespace

/// Writes the instances whose boxes in the tree touch each box.
extern "C" [[clang::export_name("wasm_scene_candidates")]] void wasm_scene_candidates(
    espalier_filled_lists* filled, const espalier_scene* scene, const espalier_box* boxes,
    espalier_query_status* statuses, std::size_t* offsets, std::size_t count, espalier_scene_candidate* candidates,
    std::size_t capacity, const espalier_scene_selection* selection) {
    *filled = collect<espalier_scene_candidate>(
        count, {statuses, offsets, candidates, capacity}, *selection, [&](std::size_t i, auto& room) {
            return espalier_scene_for_each_candidate(scene, &boxes[i], add_candidate, &room, selection->mask);
        });
}

/// Writes whether rays are rounded once for each instance and others.
extern "C" [[clang::export_name("wasm_scene_on_common_lattice")]] void wasm_scene_on_common_lattice(
    espalier_yes_no* answers, const espalier_scene* scene) {
    const std::uint32_t count = espalier_scene_instance_count(scene);
    for (std::uint32_t i = 0; i < count; ++i)
        answers[i] = espalier_scene_is_on_common_lattice(scene, {i, ESPALIER_NO_INSTANCE});
}

/// Returns the number of meshes, without those of tiles.
extern "C" [[clang::export_name("wasm_scene_mesh_count")]] std::size_t wasm_scene_mesh_count(
    const espalier_scene* scene) {
    std::size_t count = 0;
    espalier_scene_meshes(scene, &count);
    return count;
}

/// Writes all instances.
extern "C" [[clang::export_name("wasm_scene_instances")]] void wasm_scene_instances(espalier_instance* instances,
                                                                                    const espalier_scene* scene) {
    const std::uint32_t count = espalier_scene_instance_count(scene);
    for (std::uint32_t i = 0; i < count; ++i)
        instances[i] = espalier_scene_instance_at(scene, {i, ESPALIER_NO_INSTANCE}).value;
}

// Each function begins with where it writes, as C's own that return a structure.

extern "C" [[clang::export_name("wasm_scene_raycast")]] void wasm_scene_raycast(
    espalier_scene_ray_hit* hits, const espalier_scene* scene, const espalier_ray* rays, std::size_t count,
    const espalier_scene_selection* selection) {
    espalier_scene_raycast_batch(scene, rays, hits, count, selection->mask, filter_of(*selection), selection->only);
}

extern "C" [[clang::export_name("wasm_scene_occluded")]] void wasm_scene_occluded(
    espalier_yes_no* answers, const espalier_scene* scene, const espalier_ray* rays, std::size_t count,
    const espalier_scene_selection* selection) {
    for (std::size_t i = 0; i < count; ++i)
        answers[i] = espalier_scene_occluded(scene, &rays[i], selection->mask, filter_of(*selection), selection->only);
}

extern "C" [[clang::export_name("wasm_scene_all_hits")]] void wasm_scene_all_hits(
    espalier_filled_lists* filled, const espalier_scene* scene, const espalier_ray* rays,
    espalier_query_status* statuses, std::size_t* offsets, std::size_t count, espalier_scene_ray_hit* hits,
    std::size_t capacity, const espalier_scene_selection* selection) {
    *filled = collect<espalier_scene_ray_hit>(
        count, {statuses, offsets, hits, capacity}, *selection, [&](std::size_t i, auto& room) {
            return espalier_scene_for_each_hit(scene, &rays[i], add_hit, &room, selection->mask, filter_of(*selection),
                                               selection->only);
        });
}

extern "C" [[clang::export_name("wasm_scene_closest_point")]] void wasm_scene_closest_point(
    espalier_scene_closest_point_result* nearest, const espalier_scene* scene, const espalier_vec3* points,
    std::size_t count, float max_distance, std::uint32_t mask) {
    for (std::size_t i = 0; i < count; ++i)
        nearest[i] = espalier_scene_closest_point(scene, points[i], max_distance, mask);
}

#define ESPALIER_WASM_SCENE_OVERLAPS(shape)                                                                            \
    extern "C" [[clang::export_name("wasm_scene_overlaps_" #shape)]] void wasm_scene_overlaps_##shape(                 \
        espalier_yes_no* answers, const espalier_scene* scene, const espalier_##shape* shapes, std::size_t count,      \
        const espalier_scene_selection* selection) {                                                                   \
        for (std::size_t i = 0; i < count; ++i)                                                                        \
            answers[i] = espalier_scene_overlaps_##shape(scene, &shapes[i], selection->mask, filter_of(*selection),    \
                                                         selection->only);                                             \
    }                                                                                                                  \
    extern "C" [[clang::export_name("wasm_scene_collect_overlaps_" #shape)]] void wasm_scene_collect_overlaps_##shape( \
        espalier_filled_lists* filled, const espalier_scene* scene, const espalier_##shape* shapes,                    \
        espalier_query_status* statuses, std::size_t* offsets, std::size_t count, espalier_scene_triangle* triangles,  \
        std::size_t capacity, const espalier_scene_selection* selection) {                                             \
        *filled = collect<espalier_scene_triangle>(                                                                    \
            count, {statuses, offsets, triangles, capacity}, *selection, [&](std::size_t i, auto& room) {              \
                return espalier_scene_for_each_overlap_##shape(                                                        \
                    scene, &shapes[i], add_triangle, &room, selection->mask, filter_of(*selection), selection->only);  \
            });                                                                                                        \
    }

ESPALIER_WASM_SCENE_OVERLAPS(sphere)
ESPALIER_WASM_SCENE_OVERLAPS(capsule)
ESPALIER_WASM_SCENE_OVERLAPS(box)
ESPALIER_WASM_SCENE_OVERLAPS(oriented_box)
ESPALIER_WASM_SCENE_OVERLAPS(cone)
ESPALIER_WASM_SCENE_OVERLAPS(triangle)

#define ESPALIER_WASM_SCENE_SWEEP(shape)                                                                    \
    extern "C" [[clang::export_name("wasm_scene_sweep_" #shape)]] void wasm_scene_sweep_##shape(            \
        espalier_scene_sweep_hit* hits, const espalier_scene* scene, const espalier_##shape* shapes,        \
        const espalier_vec3* displacements, std::size_t count, const espalier_scene_sweep_options* options, \
        const espalier_scene_selection* selection) {                                                        \
        const espalier_scene_sweep_options filtered = with_flags(*options, *selection);                     \
        for (std::size_t i = 0; i < count; ++i)                                                             \
            hits[i] = espalier_scene_sweep_##shape##_with_options(scene, &shapes[i], displacements[i],      \
                                                                  selection->mask, &filtered);              \
    }

ESPALIER_WASM_SCENE_SWEEP(sphere)
ESPALIER_WASM_SCENE_SWEEP(capsule)
ESPALIER_WASM_SCENE_SWEEP(box)
ESPALIER_WASM_SCENE_SWEEP(oriented_box)
ESPALIER_WASM_SCENE_SWEEP(convex_hull)

// Each body has `places` places in `contacts`, of which found[i].count are filled; `room` has as many.
#define ESPALIER_WASM_SCENE_CONTACTS(shape)                                                                            \
    extern "C" [[clang::export_name("wasm_scene_find_contacts_" #shape)]] void wasm_scene_find_contacts_##shape(       \
        espalier_scene_contact* contacts, std::size_t places, espalier_filled* found, const espalier_scene* scene,     \
        const espalier_##shape* bodies, const float* margins, std::size_t count, espalier_contact* room,               \
        const espalier_scene_selection* selection) {                                                                   \
        for (std::size_t i = 0; i < count; ++i)                                                                        \
            found[i] =                                                                                                 \
                espalier_scene_find_contacts_##shape(scene, &bodies[i], margins[i], contacts + i * places, room,       \
                                                     places, selection->mask, filter_of(*selection), selection->only); \
    }

ESPALIER_WASM_SCENE_CONTACTS(sphere)
ESPALIER_WASM_SCENE_CONTACTS(capsule)
ESPALIER_WASM_SCENE_CONTACTS(oriented_box)
ESPALIER_WASM_SCENE_CONTACTS(convex_hull)
