// Scenes whose instances come, move and go: one call of the functions of C for each instance of a batch.
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <espalier/c/bake.h>
#include <espalier/c/blob.h>
#include <espalier/c/scenes/moving_scene.h>
#include <espalier/c/status.h>

#include "scene_records.hpp"

namespace {

bool are_equal(const espalier_lattice& a, const espalier_lattice& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Returns the instance in a slot; one that is free has no mesh and no source, and a mask that shares no bit.
espalier_instance instance_in(const espalier_moving_scene* scene, std::uint32_t slot) {
    const espalier_instance_result found = espalier_moving_scene_instance_of_id(scene, {slot, ESPALIER_NO_INSTANCE});
    if (found.status == ESPALIER_QUERY_OK) return found.value;
    espalier_instance free = {{{0.0f, 0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 0.0f}, 1.0f}, 0, 0, 0, 0};
    free.mesh = free.source = ESPALIER_NO_INSTANCE;
    return free;
}

}  // namespace

extern "C" [[clang::export_name("wasm_moving_scene_insert")]] void wasm_moving_scene_insert(
    espalier_instance_handle_result* handles, espalier_moving_scene* scene, const espalier_instance* instances,
    std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) handles[i] = espalier_moving_scene_insert(scene, &instances[i]);
}

extern "C" [[clang::export_name("wasm_moving_scene_remove")]] void wasm_moving_scene_remove(
    espalier_query_status* statuses, espalier_moving_scene* scene, const espalier_instance_handle* handles,
    std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) statuses[i] = espalier_moving_scene_remove(scene, handles[i]);
}

/// Moves instances as one batch, which goes on behind those that are refused, and renews the tree once.
extern "C" [[clang::export_name("wasm_moving_scene_move")]] void wasm_moving_scene_move(
    espalier_query_status* statuses, espalier_moving_scene* scene, const espalier_movement* movements,
    std::size_t count) {
    std::memset(statuses, ESPALIER_QUERY_OK, count);
    for (std::size_t begin = 0; begin < count;) {
        const espalier_filled moved = espalier_moving_scene_move_batch(scene, movements + begin, count - begin);
        begin += moved.count;
        if (moved.status != ESPALIER_QUERY_OK) statuses[begin++] = moved.status;
    }
    espalier_moving_scene_refit(scene);
}

extern "C" [[clang::export_name("wasm_moving_scene_set_masks")]] void wasm_moving_scene_set_masks(
    espalier_query_status* statuses, espalier_moving_scene* scene, const espalier_instance_word* words,
    std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        statuses[i] = espalier_moving_scene_set_mask(scene, words[i].instance, words[i].word);
}

extern "C" [[clang::export_name("wasm_moving_scene_set_users")]] void wasm_moving_scene_set_users(
    espalier_query_status* statuses, espalier_moving_scene* scene, const espalier_instance_word* words,
    std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        statuses[i] = espalier_moving_scene_set_user(scene, words[i].instance, words[i].word);
}

/// Gives all instances of a mesh, whose blob is at `place`, another blob. A refusal changes nothing.
extern "C" [[clang::export_name("wasm_moving_scene_set_mesh")]] espalier_query_status wasm_moving_scene_set_mesh(
    espalier_moving_scene* scene, std::uint32_t mesh, espalier_blob* place, const espalier_blob* blob) {
    const espalier_blob old = *place;
    *place = *blob;
    const espalier_query_status status = espalier_moving_scene_move_instances_of(scene, mesh);
    if (status != ESPALIER_QUERY_OK) {
        *place = old;
        return status;
    }
    // The slack of queries follows from the lattices, and a repack computes it anew.
    if (are_equal(espalier_blob_lattice(&old), espalier_blob_lattice(blob))) espalier_moving_scene_refit(scene);
    else espalier_moving_scene_repack(scene);
    return status;
}

/// Writes the handle of each slot that was ever used.
extern "C" [[clang::export_name("wasm_moving_scene_handles")]] void wasm_moving_scene_handles(
    espalier_instance_handle_result* handles, const espalier_moving_scene* scene) {
    const std::uint32_t end = espalier_moving_scene_slot_end(scene);
    for (std::uint32_t slot = 0; slot < end; ++slot) handles[slot] = espalier_moving_scene_handle_of(scene, slot);
}

/// Writes the instance of each slot that was ever used.
extern "C" [[clang::export_name("wasm_moving_scene_instances")]] void wasm_moving_scene_instances(
    espalier_instance* instances, const espalier_moving_scene* scene) {
    const std::uint32_t end = espalier_moving_scene_slot_end(scene);
    for (std::uint32_t slot = 0; slot < end; ++slot) instances[slot] = instance_in(scene, slot);
}

/// Writes whether rays are rounded once for each instance and others.
extern "C" [[clang::export_name("wasm_moving_scene_on_common_lattice")]] void wasm_moving_scene_on_common_lattice(
    espalier_yes_no* answers, const espalier_moving_scene* scene, const espalier_instance_handle* handles,
    std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const espalier_query_status status = espalier_moving_scene_box_of(scene, handles[i]).status;  // of a stale one
        answers[i] = {status};
        if (status == ESPALIER_QUERY_OK)
            answers[i] = espalier_moving_scene_is_on_common_lattice(scene, {handles[i].slot, ESPALIER_NO_INSTANCE});
    }
}

/// Writes the box of each instance in the tree.
extern "C" [[clang::export_name("wasm_moving_scene_boxes")]] void wasm_moving_scene_boxes(
    espalier_box_result* boxes, const espalier_moving_scene* scene, const espalier_instance_handle* handles,
    std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) boxes[i] = espalier_moving_scene_box_of(scene, handles[i]);
}

/// Writes where the bytes of a snapshot are.
extern "C" [[clang::export_name("wasm_moving_scene_block")]] void wasm_moving_scene_block(
    espalier_bytes* block, const espalier_moving_scene* scene) {
    block->bytes = espalier_moving_scene_block(scene, &block->byte_count);
}
