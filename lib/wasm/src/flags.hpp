// Filters: flags, which queries read by functions that C passes to them.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/c/types.h>

/// A flag for each number of a triangle, an instance or a slot: a query takes those into account that are not 0.
struct espalier_flags {
    const std::uint8_t* first;
    std::size_t count;
};

namespace espalier::wasm {

/// Returns the flag of a number; behind the last there is none.
inline bool has_flag(const espalier_flags& flags, std::uint32_t number) {
    return number < flags.count && flags.first[number] != 0;
}

/// Reads the flag of a triangle: the filter of queries of one blob, with flags as `user`.
inline bool keeps_triangle(espalier_triangle_id triangle, void* user) {
    return has_flag(*static_cast<const espalier_flags*>(user), triangle);
}

}  // namespace espalier::wasm
