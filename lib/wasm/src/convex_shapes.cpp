// Hulls and volumes of any number of vertices or planes, which lie in one array: those of shape i begin at offsets[i].
#include <cstddef>
#include <cstdint>

#include <espalier/c/shapes.h>

namespace {

/// Writes a shape for each query: one that was given serves all.
template <class Shape, class Part>
void place_each(Shape* shapes, std::size_t count, const Part* parts, const std::uint32_t* offsets, std::size_t given) {
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t* const begin = offsets + (given == 1 ? 0 : i);
        shapes[i] = {parts + begin[0], begin[1] - begin[0]};
    }
}

}  // namespace

extern "C" [[clang::export_name("wasm_place_convex_hull")]] void wasm_place_convex_hull(espalier_convex_hull* hulls,
                                                                                        std::size_t count,
                                                                                        const espalier_vec3* vertices,
                                                                                        const std::uint32_t* offsets,
                                                                                        std::size_t given) {
    place_each(hulls, count, vertices, offsets, given);
}

extern "C" [[clang::export_name("wasm_place_convex_volume")]] void wasm_place_convex_volume(
    espalier_convex_volume* volumes, std::size_t count, const espalier_plane* planes, const std::uint32_t* offsets,
    std::size_t given) {
    place_each(volumes, count, planes, offsets, given);
}
