// Lists of which each is as long as its query makes it: what the package exports beside the batches of C.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/c/batches/arrays.h>
#include <espalier/c/status.h>
#include <espalier/c/types.h>
#include <espalier/c/visitor.h>

namespace espalier::wasm {

/// Where a batch writes its lists: statuses has `count` elements, offsets one more, items `capacity`.
template <class Item>
struct ListArrays {
    espalier_query_status* statuses;
    std::size_t* offsets;
    Item* items;
    std::size_t capacity;
};

/// The rest of an array, and the number of elements that were added, which may be more than it holds.
template <class Item>
struct Room {
    Item* places;
    std::size_t capacity;
    std::size_t added = 0;

    /// More elements than memory has room for count as one too many, so that the number does not wrap.
    void add(const Item& item) {
        if (added < capacity) places[added] = item;
        if (added <= PTRDIFF_MAX / sizeof(Item)) ++added;
    }
};

/// Adds an element to the Room that `user` points to: the visitor of functions that pass an element by its address.
template <class Item>
espalier_visit add_to_room(const Item* item, void* user) {
    static_cast<Room<Item>*>(user)->add(*item);
    return ESPALIER_VISIT_NEXT;
}

/// Writes a list for each query, as the batches of C do. list(i, room) adds the elements of query i and returns its
/// status.
template <class Item, class List>
espalier_filled_lists collect_lists(std::size_t count, const ListArrays<Item>& to, const List& list) {
    to.offsets[0] = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t begin = to.offsets[i];
        Room<Item> room = {to.items + begin, to.capacity - begin};
        const espalier_query_status status = list(i, room);
        if (room.added > room.capacity) return {i, begin, room.added, ESPALIER_QUERY_OUTPUT_FULL};
        to.statuses[i] = status;
        to.offsets[i + 1] = begin + room.added;
    }
    return {count, to.offsets[count], 0, ESPALIER_QUERY_OK};
}

}  // namespace espalier::wasm
