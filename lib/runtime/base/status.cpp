// The sentence that describes each status.
#include <espalier/status.hpp>

namespace espalier {

const char* describe(OpenStatus status) noexcept {
    switch (status) {
        case OpenStatus::ok:
            return "ok";
        case OpenStatus::too_short:
            return "the blob is cut short: there are fewer bytes than its header states, or not even a header";
        case OpenStatus::trailing_bytes:
            return "there are more bytes than the blob's header states";
        case OpenStatus::not_a_blob:
            return "these bytes are not an Espalier blob: they do not begin with ESPL";
        case OpenStatus::unsupported_version:
            return "the blob's format version is not one that this library reads: bake it again, or update the library";
        case OpenStatus::unsupported_profile:
            return "the blob uses a profile that this library does not read";
        case OpenStatus::unsupported_feature:
            return "the blob has an optional section that this library does not read";
        case OpenStatus::bad_header:
            return "a field of the blob's header is out of its range";
        case OpenStatus::bad_checksum:
            return "the blob is damaged: its checksum does not match its bytes";
        case OpenStatus::bad_node:
            return "a node of the blob breaks the format's rules";
        case OpenStatus::bad_leaf:
            return "a leaf of the blob breaks the format's rules";
        case OpenStatus::bad_section:
            return "an optional section of the blob breaks the format's rules, or bytes are left over";
        case OpenStatus::not_opened:
            return "the blob was never opened: call open first";
        case OpenStatus::misaligned:
            return "the espalier_blob to open into lies at an address that is no multiple of 16: align it";
        case OpenStatus::not_a_remap:
            return "these bytes are not a remap file that this library reads, or they are damaged";
        case OpenStatus::other_blob:
            return "the remap file belongs to another blob, or the array has another size than it";
        case OpenStatus::not_a_scene:
            return "these bytes are not an Espalier scene: they do not begin with ESPS";
        case OpenStatus::bad_instance:
            return "an instance of the scene breaks the format's rules";
        case OpenStatus::too_few_meshes:
            return "an array for the meshes or tiles of the scene is too small: mesh_count_of_scene and "
                   "tile_count_of_scene return their sizes";
    }
    return "not a status of this library";
}

const char* describe(QueryStatus status) noexcept {
    switch (status) {
        case QueryStatus::ok:
            return "the query is complete";
        case QueryStatus::stopped:
            return "the visitor stopped the query";
        case QueryStatus::invalid_argument:
            return "an argument is invalid: NaN, or infinite, negative or of length zero where that is not allowed";
        case QueryStatus::out_of_range:
            return "an argument is too far away or too large for the lattice that the blob was baked on";
        case QueryStatus::not_closed:
            return "the blob's surface is not closed, so it has no inside";
        case QueryStatus::work_limit:
            return "the limit of work was reached before the answer was complete";
        case QueryStatus::output_full:
            return "the array is full and there is more to report";
        case QueryStatus::not_found:
            return "nothing was found";
        case QueryStatus::not_open:
            return "the blob is not open: it was never opened, or its bytes were refused";
        case QueryStatus::no_data:
            return "the blob was baked without the section that this query reads";
    }
    return "not a query status of this library";
}

}  // namespace espalier
