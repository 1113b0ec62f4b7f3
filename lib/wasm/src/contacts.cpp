// Contacts and planes of an array of bodies: one call of the functions of C for each.
#include <cstddef>
#include <cstdint>

#include <espalier/c/blob.h>
#include <espalier/c/contact.h>
#include <espalier/c/shapes.h>
#include <espalier/c/status.h>

// Each body has `places` places in `contacts`, of which found[i].count are filled.
#define ESPALIER_WASM_CONTACTS(shape)                                                                               \
    extern "C" [[clang::export_name("wasm_find_contacts_" #shape)]] void wasm_find_contacts_##shape(                \
        espalier_contact* contacts, std::size_t places, espalier_filled* found, const espalier_blob* blob,          \
        const espalier_##shape* bodies, const float* margins, std::size_t count) {                                  \
        for (std::size_t i = 0; i < count; ++i)                                                                     \
            found[i] = espalier_find_contacts_##shape(blob, &bodies[i], margins[i], contacts + i * places, places); \
    }

ESPALIER_WASM_CONTACTS(sphere)
ESPALIER_WASM_CONTACTS(capsule)
ESPALIER_WASM_CONTACTS(oriented_box)
ESPALIER_WASM_CONTACTS(convex_hull)

extern "C" [[clang::export_name("wasm_collect_planes")]] void wasm_collect_planes(
    espalier_contact_plane* planes, std::size_t places, espalier_filled* found, const espalier_blob* blob,
    const espalier_capsule* bodies, const float* margins, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        found[i] = espalier_collect_planes(blob, &bodies[i], margins[i], planes + i * places, places);
}

/// Solves each list of planes, which offsets divide.
extern "C" [[clang::export_name("wasm_solve_planes")]] void wasm_solve_planes(espalier_vec3_result* ways,
                                                                              const espalier_contact_plane* planes,
                                                                              const std::uint32_t* offsets,
                                                                              const espalier_vec3* wishes,
                                                                              const float* skins, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        ways[i] = espalier_solve_planes(planes + offsets[i], offsets[i + 1] - offsets[i], wishes[i], skins[i]);
}
