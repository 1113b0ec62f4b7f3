#include <math.h>

#include "c/asking.h"

#define CAPACITY 20000

static unsigned char memory[CAPACITY];
static unsigned char whole[CAPACITY];
static unsigned char copy_of_memory[CAPACITY];

static bool is_filled_with(const void* place, size_t size, unsigned char value) {
    for (size_t i = 0; i < size; ++i)
        if (((const unsigned char*)place)[i] != value) return false;
    return true;
}

/* Whether a mesh refuses everything with a status. */
static int misbehaviour_of_refused(espalier_deformable* mesh, espalier_query_status status) {
    const espalier_vec3 position = {0, 0, 0};
    const espalier_box range = espalier_deformable_range(mesh);
    unsigned char byte = 0xA5;
    if (espalier_deformable_status(mesh) != status) return 1;
    if (espalier_deformable_position_count(mesh) != 0) return 2;
    if (!is_filled_with(&range, sizeof range, 0)) return 3;
    if (espalier_blob_status(espalier_deformable_blob(mesh)) != ESPALIER_OPEN_NOT_OPENED) return 4;
    for (size_t count = 0; count < 2; ++count) {
        const espalier_refit_result result = espalier_deformable_refit(mesh, count == 0 ? NULL : &position, count);
        if (result.status != status || result.position != 0 || result.quality != 0) return 5;
    }
    if (espalier_deformable_seal(mesh, NULL, 0) != status) return 6;
    if (espalier_deformable_seal(mesh, &byte, 1) != status || byte != 0xA5) return 7;
    return 0;
}

/* Each blob, size and address that a creation refuses, into a view that was something else before. */
static int misbehaviour_of_create(const espalier_blob* blob, const espalier_blob* rigid) {
    static espalier_blob zero;
    static espalier_deformable room[2];
    const size_t size = espalier_deformable_bytes(blob);
    espalier_deformable mesh;
    if (size == 0 || size > CAPACITY || size >= espalier_blob_size(blob)) return 20;
    if (!espalier_blob_is_deformable(blob) || espalier_blob_is_deformable(rigid)) return 21;
    if (espalier_deformable_bytes(rigid) != 0 || espalier_deformable_bytes(&zero) != 0) return 22;
    memset(memory, 0xA5, sizeof memory);
    for (int refused = 0; refused < 5; ++refused) {
        const espalier_blob* const from = refused == 0 ? &zero : refused == 1 ? rigid : blob;
        void* const place = refused == 2 ? NULL : memory;
        const size_t room_size = refused == 2 ? 0 : refused == 3 ? size - 1 : refused == 4 ? 1 : CAPACITY;
        const espalier_query_status status = refused == 0   ? ESPALIER_QUERY_NOT_OPEN
                                             : refused == 1 ? ESPALIER_QUERY_NO_DATA
                                                            : ESPALIER_QUERY_NO_ROOM;
        memset(&mesh, 0xA5, sizeof mesh);
        if (espalier_create_deformable(from, place, room_size, &mesh) != status) return 30 + refused;
        if (misbehaviour_of_refused(&mesh, status) != 0) return 40 + refused;
    }
    for (uintptr_t offset = 1; offset < 16; ++offset) {
        espalier_deformable* misaligned = (espalier_deformable*)((uintptr_t)room + offset);
        memset(room, 0xA5, sizeof room);
        if (espalier_create_deformable(blob, memory, sizeof memory, misaligned) != ESPALIER_QUERY_INVALID_ARGUMENT)
            return 23;
        if (!is_filled_with(room, sizeof room, 0xA5)) return 24;
    }
    if (!is_filled_with(memory, sizeof memory, 0xA5)) return 25;
    for (size_t offset = 0; offset < 4; ++offset) {
        memset(memory, 0xA5, sizeof memory);
        if (espalier_create_deformable(blob, memory + offset, size, &mesh) != ESPALIER_QUERY_OK) return 26;
        if (espalier_deformable_status(&mesh) != ESPALIER_QUERY_OK) return 27;
        if (!is_filled_with(memory, offset, 0xA5)) return 28;
        if (!is_filled_with(memory + offset + size, CAPACITY - offset - size, 0xA5)) return 29;
    }
    return 0;
}

/* A refit to positions of which one is not accepted. */
static int misbehaviour_of_position(espalier_deformable* mesh, const struct deformable_blob* blob, uint32_t index,
                                    espalier_vec3 position, espalier_query_status status) {
    static espalier_vec3 positions[1000];
    const size_t size = espalier_deformable_bytes(espalier_deformable_blob(mesh));
    if (blob->count > sizeof positions / sizeof *positions || size > sizeof copy_of_memory) return 1;
    memcpy(positions, blob->pose, blob->count * sizeof *positions);
    memcpy(copy_of_memory, memory, size);
    positions[index] = position;
    positions[blob->count - 1] = position; /* the first one is named */
    const espalier_refit_result result = espalier_deformable_refit(mesh, positions, blob->count);
    if (result.status != status || result.position != index || result.quality != 0) return 2;
    return memcmp(copy_of_memory, memory, size) == 0 ? 0 : 3;
}

static int misbehaviour_of_refit(espalier_deformable* mesh, const struct deformable_blob* blob) {
    const espalier_box range = espalier_deformable_range(mesh);
    const uint32_t count = espalier_deformable_position_count(mesh);
    if (count != blob->count || count < 3) return 50;
    for (int axis = 0; axis < 3; ++axis) {
        const float values[] = {NAN, INFINITY, -INFINITY, 3e38f, -3e38f};
        for (int i = 0; i < 5; ++i) {
            espalier_vec3 position = range.min;
            *(axis == 0 ? &position.x : axis == 1 ? &position.y : &position.z) = values[i];
            if (misbehaviour_of_position(mesh, blob, count / 2, position,
                                         i < 3 ? ESPALIER_QUERY_INVALID_ARGUMENT : ESPALIER_QUERY_OUT_OF_RANGE) != 0)
                return 51;
        }
    }
    const espalier_vec3 behind = {range.max.x + (range.max.x - range.min.x) / 1000, range.max.y, range.max.z};
    if (misbehaviour_of_position(mesh, blob, 0, behind, ESPALIER_QUERY_OUT_OF_RANGE) != 0) return 52;

    espalier_refit_result result = espalier_deformable_refit(mesh, NULL, 0);
    if (result.status != ESPALIER_QUERY_INVALID_ARGUMENT || result.position != 0) return 53;
    result = espalier_deformable_refit(mesh, blob->rest, count - 1);
    if (result.status != ESPALIER_QUERY_INVALID_ARGUMENT || result.position != count - 1) return 54;
    result = espalier_deformable_refit(mesh, blob->rest, SIZE_MAX); /* none is read */
    if (result.status != ESPALIER_QUERY_INVALID_ARGUMENT || result.position != count) return 55;
    result = espalier_deformable_refit(mesh, blob->pose, count);
    if (result.status != ESPALIER_QUERY_OK || result.position != 0 || !(result.quality > 0)) return 56;
    result = espalier_deformable_refit(mesh, blob->rest, count);
    if (result.status != ESPALIER_QUERY_OK || !(fabsf(result.quality - 1) < 1e-5f)) return 57;
    return 0;
}

static int misbehaviour_of_seal(espalier_deformable* mesh, const espalier_blob* baked,
                                const struct deformable_blob* blob) {
    const size_t size = blob->size;
    espalier_blob opened, in_place;
    espalier_deformable other;
    if (size > CAPACITY) return 60;
    memset(whole, 0xA5, sizeof whole);
    for (int more = -1; more < 2; more += 2)
        if (espalier_deformable_seal(mesh, whole, more < 0 ? size - 1 : size + 1) != ESPALIER_QUERY_NO_ROOM) return 61;
    if (espalier_deformable_seal(mesh, NULL, 0) != ESPALIER_QUERY_NO_ROOM) return 62;
    if (!is_filled_with(whole, sizeof whole, 0xA5)) return 63;
    if (espalier_deformable_seal(mesh, whole, size) != ESPALIER_QUERY_OK) return 64;
    if (memcmp(whole, blob->bytes, size) != 0) return 65; /* at rest */
    if (!is_filled_with(whole + size, CAPACITY - size, 0xA5)) return 66;

    if (espalier_deformable_refit(mesh, blob->pose, blob->count).status != ESPALIER_QUERY_OK) return 67;
    if (espalier_deformable_seal(mesh, whole, size) != ESPALIER_QUERY_OK) return 68;
    if (espalier_open(whole, size, &opened) != ESPALIER_OPEN_OK) return 69;
    if (espalier_blob_checksum(&opened) == espalier_blob_checksum(baked)) return 70;
    const espalier_box moved = espalier_blob_bounds(&opened);
    const espalier_box bounds = espalier_blob_bounds(espalier_deformable_blob(mesh));
    if (memcmp(&moved, &bounds, sizeof moved) != 0 || moved.max.x <= espalier_blob_bounds(baked).max.x) return 71;

    /* The bytes of a blob as the memory of the mesh: they become those that the other mesh sealed. */
    memcpy(copy_of_memory, blob->bytes, size);
    if (espalier_open(copy_of_memory, size, &in_place) != ESPALIER_OPEN_OK) return 72;
    if (espalier_create_deformable(&in_place, copy_of_memory, espalier_deformable_bytes(&in_place), &other) !=
        ESPALIER_QUERY_OK)
        return 73;
    if (espalier_deformable_refit(&other, blob->pose, blob->count).status != ESPALIER_QUERY_OK) return 74;
    if (espalier_deformable_seal(&other, copy_of_memory, size) != ESPALIER_QUERY_OK) return 75;
    if (memcmp(copy_of_memory, whole, size) != 0) return 76;

    /* A mesh of a mesh has its pose. */
    if (espalier_create_deformable(espalier_deformable_blob(mesh), copy_of_memory, CAPACITY, &other) !=
        ESPALIER_QUERY_OK)
        return 77;
    if (espalier_deformable_refit(mesh, blob->rest, blob->count).status != ESPALIER_QUERY_OK) return 78;
    if (espalier_deformable_seal(&other, whole, size) != ESPALIER_QUERY_OK) return 79;
    if (espalier_open(whole, size, &opened) != ESPALIER_OPEN_OK) return 80;
    const espalier_box kept = espalier_blob_bounds(&opened);
    return memcmp(&kept, &moved, sizeof kept) == 0 ? 0 : 81;
}

int misbehaviour_of_deformables(const struct deformable_blob* blob) {
    static espalier_deformable zero; /* as static storage is */
    espalier_deformable mesh, copy;
    espalier_blob baked;
    int wrong = misbehaviour_of_refused(&zero, ESPALIER_QUERY_NOT_OPEN);
    if (wrong != 0) return wrong;
    if (espalier_open(blob->bytes, blob->size, &baked) != ESPALIER_OPEN_OK) return 90;
    wrong = misbehaviour_of_create(&baked, blob->rigid);
    if (wrong != 0) return wrong;
    if (espalier_create_deformable(&baked, memory, sizeof memory, &mesh) != ESPALIER_QUERY_OK) return 91;
    copy = mesh; /* as good as the mesh */
    wrong = misbehaviour_of_refit(&copy, blob);
    if (wrong == 0) wrong = misbehaviour_of_seal(&mesh, &baked, blob);
    return wrong;
}
