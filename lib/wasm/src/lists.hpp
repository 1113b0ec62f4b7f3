// What the package exports for lists, beside the batches of C.
#pragma once

#include <cstddef>

#include <espalier/c/batches/arrays.h>
#include <espalier/c/blob.h>
#include <espalier/c/overlap.h>
#include <espalier/c/status.h>
#include <espalier/c/types.h>

namespace espalier::wasm {

/// Where a batch writes its lists: statuses has `count` elements, offsets one more, triangles `capacity`.
struct TriangleLists {
    espalier_query_status* statuses;
    std::size_t* offsets;
    espalier_triangle_id* triangles;
    std::size_t capacity;
};

template <class Shape>
using ForEachOverlap = espalier_query_status (*)(const espalier_blob*, const Shape*, espalier_triangle_visitor, void*);

/// The rest of an array, and the number of triangles that were visited, which may be more than it holds.
struct Room {
    espalier_triangle_id* places;
    std::size_t capacity;
    std::size_t visited = 0;
};

inline espalier_visit write_to_room(espalier_triangle_id triangle, const espalier_triangle*, void* user) {
    Room& room = *static_cast<Room*>(user);
    if (room.visited < room.capacity) room.places[room.visited] = triangle;
    ++room.visited;
    return ESPALIER_VISIT_NEXT;
}

/// Writes the triangles that touch each shape, as espalier_collect_overlaps_sphere_arrays() does for spheres.
template <class Shape>
espalier_filled_lists collect_overlaps(const espalier_blob* blob, const Shape* shapes, std::size_t count,
                                       const TriangleLists& to, ForEachOverlap<Shape> for_each) {
    to.offsets[0] = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t begin = to.offsets[i];
        Room room = {to.triangles + begin, to.capacity - begin};
        const espalier_query_status status = for_each(blob, &shapes[i], write_to_room, &room);
        if (room.visited > room.capacity) return {i, begin, room.visited, ESPALIER_QUERY_OUTPUT_FULL};
        to.statuses[i] = status;
        to.offsets[i + 1] = begin + room.visited;
    }
    return {count, to.offsets[count], 0, ESPALIER_QUERY_OK};
}

}  // namespace espalier::wasm
