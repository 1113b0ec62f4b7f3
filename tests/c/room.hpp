// Memory in which C may be told to place a handle.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>

namespace espalier::tests {

/// An array that was something else before.
template <class T>
struct Room {
    T array[17];

    Room() { clear(); }
    void clear() { std::memset(static_cast<void*>(array), 0xA5, sizeof array); }
    T* at(std::size_t offset) { return reinterpret_cast<T*>(reinterpret_cast<std::uintptr_t>(array) + offset); }
    [[nodiscard]] bool is_untouched() const {
        const auto* const bytes = reinterpret_cast<const unsigned char*>(array);
        return std::all_of(bytes, bytes + sizeof array, [](unsigned char byte) { return byte == 0xA5; });
    }
};

/// Checks that a function refuses each address that `alignment` does not divide, and writes nothing there.
template <class T, class Refuses>
void check_misaligned(std::size_t alignment, Refuses refuses) {
    Room<T> room;
    for (std::size_t offset = 1; offset < alignment; ++offset) CHECK(refuses(room.at(offset)));
    CHECK(room.is_untouched());
}

}  // namespace espalier::tests
