// espalier.h: opening, what a blob says of itself, contacts.
#include <cstdint>

#include <runtime/c/twins.hpp>

using namespace espalier;
using namespace espalier::detail;

namespace {

/// Vectors of the blob are loaded at addresses that are multiples of 16. Other languages allocate as they please.
bool is_aligned(const espalier_blob* blob) { return reinterpret_cast<std::uintptr_t>(blob) % alignof(Blob) == 0; }

}  // namespace

extern "C" {

const char* espalier_describe_status(espalier_status status) { return describe(static_cast<Status>(status)); }

const char* espalier_describe_query_status(espalier_query_status status) {
    return describe(static_cast<QueryStatus>(status));
}

espalier_status espalier_open(const void* bytes, size_t size, espalier_blob* blob) {
    if (!is_aligned(blob)) return ESPALIER_STATUS_MISALIGNED;
    return static_cast<espalier_status>(open({static_cast<const std::byte*>(bytes), size}, *twin(blob)));
}

espalier_status espalier_open_trusted_image(const void* bytes, size_t size, espalier_blob* blob) {
    if (!is_aligned(blob)) return ESPALIER_STATUS_MISALIGNED;
    return static_cast<espalier_status>(open_trusted_image({static_cast<const std::byte*>(bytes), size}, *twin(blob)));
}

uint32_t espalier_blob_triangle_count(const espalier_blob* blob) { return twin(blob)->triangle_count(); }
uint32_t espalier_blob_copy_count(const espalier_blob* blob) { return twin(blob)->copy_count(); }
uint32_t espalier_blob_vertex_count(const espalier_blob* blob) { return twin(blob)->vertex_count(); }
uint32_t espalier_blob_size_bytes(const espalier_blob* blob) { return twin(blob)->size_bytes(); }
uint32_t espalier_blob_checksum(const espalier_blob* blob) { return twin(blob)->checksum(); }
unsigned espalier_blob_depth(const espalier_blob* blob) { return twin(blob)->depth(); }
unsigned espalier_blob_bits(const espalier_blob* blob) { return twin(blob)->bits(); }
espalier_profile espalier_blob_profile(const espalier_blob* blob) {
    return static_cast<espalier_profile>(twin(blob)->profile());
}
float espalier_blob_step(const espalier_blob* blob) { return twin(blob)->step(); }
float espalier_blob_max_error(const espalier_blob* blob) { return twin(blob)->max_error(); }
espalier_vec3 espalier_blob_bounds_min(const espalier_blob* blob) { return twin_value(twin(blob)->bounds_min()); }
espalier_vec3 espalier_blob_bounds_max(const espalier_blob* blob) { return twin_value(twin(blob)->bounds_max()); }
bool espalier_blob_closed(const espalier_blob* blob) { return twin(blob)->closed(); }
bool espalier_blob_has_original_ids(const espalier_blob* blob) { return twin(blob)->has_original_ids(); }
bool espalier_blob_has_materials(const espalier_blob* blob) { return twin(blob)->has_materials(); }
bool espalier_blob_has_edge_flags(const espalier_blob* blob) { return twin(blob)->has_edge_flags(); }

uint16_t espalier_material(const espalier_blob* blob, espalier_triangle triangle) {
    return material(*twin(blob), {triangle});
}

bool espalier_get_edge_kinds(const espalier_blob* blob, espalier_triangle triangle, espalier_edge_kinds* kinds) {
    return edge_kinds(*twin(blob), {triangle}, *twin(kinds));
}

bool espalier_is_on_inner_edge(const espalier_blob* blob, const espalier_contact* contact, espalier_vec3* normal) {
    return is_on_inner_edge(*twin(blob), *twin(contact), *twin(normal));
}

}  // extern "C"
