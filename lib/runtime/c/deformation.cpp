// espalier/c/deformation.h: meshes that change their vertices.
#include <runtime/c/abi.hpp>

using namespace espalier;
using namespace espalier::detail;

size_t espalier_deformable_bytes(const espalier_blob* blob) { return deformable_bytes(cpp(blob)); }

espalier_query_status espalier_create_deformable(const espalier_blob* blob, void* memory, size_t size,
                                                 espalier_deformable* mesh) {
    if (!is_aligned(mesh)) return ESPALIER_QUERY_INVALID_ARGUMENT;
    *mesh = c(create_deformable(cpp(blob), {static_cast<std::byte*>(memory), size}));
    return c(cpp(mesh).status());
}

espalier_query_status espalier_deformable_status(const espalier_deformable* mesh) { return c(cpp(mesh).status()); }

const espalier_blob* espalier_deformable_blob(const espalier_deformable* mesh) { return twin(&cpp(mesh).blob()); }

uint32_t espalier_deformable_position_count(const espalier_deformable* mesh) { return cpp(mesh).position_count(); }

espalier_box espalier_deformable_range(const espalier_deformable* mesh) { return c(cpp(mesh).range()); }

ESPALIER_C_FUNCTION(espalier_deformable_refit, (mesh, positions, count), c(refit(cpp(mesh), cpp(positions, count))))

ESPALIER_C_FUNCTION(espalier_deformable_seal, (mesh, bytes, size),
                    c(seal(cpp(mesh), {static_cast<std::byte*>(bytes), size})))
