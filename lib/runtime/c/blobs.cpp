// espalier/c/status.h, blob.h and contact.h: opening, the properties of a blob, contacts.
#include <runtime/c/abi.hpp>

using namespace espalier;
using namespace espalier::detail;

namespace {

/// Opens in place. Vectors of the blob are loaded at addresses that are multiples of 16.
template <Blob (*open)(std::span<const std::byte>) noexcept>
espalier_open_status open_at(espalier_blob* place, const void* bytes, std::size_t size) {
    if (!is_aligned(place)) return ESPALIER_OPEN_MISALIGNED;
    *place = c(open({static_cast<const std::byte*>(bytes), size}));
    return c(cpp(place).status());
}

}  // namespace

const char* espalier_describe_open_status(espalier_open_status status) { return describe(OpenStatus{status}); }

const char* espalier_describe_query_status(espalier_query_status status) { return describe(QueryStatus{status}); }

ESPALIER_C_FUNCTION(espalier_open, (bytes, size, blob), open_at<open>(blob, bytes, size))

ESPALIER_C_FUNCTION(espalier_open_unchecked, (bytes, size, blob), open_at<open_unchecked>(blob, bytes, size))

espalier_open_status espalier_blob_status(const espalier_blob* blob) { return c(cpp(blob).status()); }
uint32_t espalier_blob_triangle_count(const espalier_blob* blob) { return cpp(blob).triangle_count(); }
ESPALIER_C_FUNCTION(espalier_blob_duplicate_reference_count, (blob), cpp(blob).duplicate_reference_count())
uint32_t espalier_blob_vertex_count(const espalier_blob* blob) { return cpp(blob).vertex_count(); }
uint32_t espalier_blob_size(const espalier_blob* blob) { return cpp(blob).size(); }
uint32_t espalier_blob_checksum(const espalier_blob* blob) { return cpp(blob).checksum(); }
unsigned espalier_blob_depth(const espalier_blob* blob) { return cpp(blob).depth(); }
espalier_profile espalier_blob_profile(const espalier_blob* blob) { return c(cpp(blob).profile()); }
espalier_lattice espalier_blob_lattice(const espalier_blob* blob) { return c(cpp(blob).lattice()); }
float espalier_blob_max_error(const espalier_blob* blob) { return cpp(blob).max_error(); }
espalier_vec3d espalier_blob_source_origin(const espalier_blob* blob) { return c(cpp(blob).source_origin()); }
espalier_box espalier_blob_bounds(const espalier_blob* blob) { return c(cpp(blob).bounds()); }
bool espalier_blob_is_closed(const espalier_blob* blob) { return cpp(blob).is_closed(); }
bool espalier_blob_is_deformable(const espalier_blob* blob) { return cpp(blob).is_deformable(); }
bool espalier_blob_has_original_ids(const espalier_blob* blob) { return cpp(blob).has_original_ids(); }
bool espalier_blob_has_materials(const espalier_blob* blob) { return cpp(blob).has_materials(); }
bool espalier_blob_has_edge_flags(const espalier_blob* blob) { return cpp(blob).has_edge_flags(); }

ESPALIER_C_FUNCTION(espalier_material, (blob, triangle), material(cpp(blob), cpp(triangle)))

ESPALIER_C_FUNCTION(espalier_edge_kinds_of, (blob, triangle), c(edge_kinds(cpp(blob), cpp(triangle))))

ESPALIER_C_FUNCTION(espalier_fix_internal_edge_normal, (blob, triangle, feature, normal),
                    c(fix_internal_edge_normal(cpp(blob), cpp(triangle), Feature{feature}, cpp(normal))))
