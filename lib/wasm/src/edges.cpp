// Edges of an array of triangles, and lists of contacts that are reduced.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <espalier/c/contact.h>

extern "C" [[clang::export_name("wasm_edge_kinds")]] void wasm_edge_kinds(espalier_edge_kinds_result* kinds,
                                                                          const espalier_blob* blob,
                                                                          const espalier_triangle_id* triangles,
                                                                          std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) kinds[i] = espalier_edge_kinds_of(blob, triangles[i]);
}

extern "C" [[clang::export_name("wasm_fix_internal_edge_normals")]] void wasm_fix_internal_edge_normals(
    espalier_vec3* normals, const espalier_blob* blob, const espalier_triangle_id* triangles,
    const espalier_feature* features, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        normals[i] = espalier_fix_internal_edge_normal(blob, triangles[i], features[i], normals[i]);
}

/// Reduces each list of contacts, which offsets divide, and moves what is kept to the front. Writes the new offsets.
extern "C" [[clang::export_name("wasm_reduce_contacts")]] void wasm_reduce_contacts(espalier_contact* contacts,
                                                                                    std::uint32_t* offsets,
                                                                                    std::size_t lists) {
    std::size_t end = 0;
    for (std::size_t i = 0; i < lists; ++i) {
        espalier_contact* const first = contacts + offsets[i];
        const std::size_t kept = espalier_reduce_contacts(first, offsets[i + 1] - offsets[i]);
        std::copy(first, first + kept, contacts + end);
        offsets[i] = static_cast<std::uint32_t>(end);
        end += kept;
    }
    offsets[lists] = static_cast<std::uint32_t>(end);
}
