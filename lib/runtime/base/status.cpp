// The sentence that describes each status.
#include <espalier/status.hpp>

namespace espalier {

const char* describe(OpenStatus status) noexcept {
    switch (status) {
        case OpenStatus::ok:
            return "ok";
        case OpenStatus::too_short:
            return "the bytes are cut short: there are fewer than the header states, or not even a header";
        case OpenStatus::trailing_bytes:
            return "there are more bytes than the header states";
        case OpenStatus::not_a_blob:
            return "these bytes are not an Espalier blob, which begins with ESPL; a scene begins with ESPS";
        case OpenStatus::unsupported_version:
            return "the format version is not one that this library reads: bake again, or update the library";
        case OpenStatus::unsupported_profile:
            return "the blob uses a profile that this library does not read";
        case OpenStatus::unsupported_feature:
            return "the blob has an optional section that this library does not read";
        case OpenStatus::bad_header:
            return "a field of the header is out of its range";
        case OpenStatus::bad_checksum:
            return "the bytes are damaged: their checksum does not match";
        case OpenStatus::bad_node:
            return "a node breaks the format's rules";
        case OpenStatus::bad_leaf:
            return "a leaf breaks the format's rules";
        case OpenStatus::bad_section:
            return "a section of the blob or a part of the scene breaks the format's rules, or bytes are left over";
        case OpenStatus::not_opened:
            return "nothing was opened: call open or open_scene first";
        case OpenStatus::misaligned:
            return "the espalier_blob or espalier_scene to open into lies at an address that is no multiple of 16: "
                   "align it";
        case OpenStatus::not_a_remap:
            return "these bytes are not a remap file that this library reads, or they are damaged";
        case OpenStatus::other_blob:
            return "the remap file belongs to another blob, or the array has another size than it";
        case OpenStatus::not_a_scene:
            return "these bytes are not an Espalier scene, which begins with ESPS; a blob begins with ESPL";
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
            return "an argument is invalid: NaN, or infinite, negative or of length zero where that is not allowed, an "
                   "id or a number of elements that does not fit, or a mesh or tile that is empty or not open";
        case QueryStatus::out_of_range:
            return "an argument is too far away or too large for the lattice that the blob was baked on or for the "
                   "world of the moving scene, or it is a slot that was never used, or outside of a mesh's range of "
                   "motion";
        case QueryStatus::not_closed:
            return "the blob's surface is not closed, so it has no inside";
        case QueryStatus::work_limit:
            return "the limit of work was reached before the answer was complete";
        case QueryStatus::output_full:
            return "the array is full and there is more to report";
        case QueryStatus::not_found:
            return "nothing was found";
        case QueryStatus::not_open:
            return "the blob or scene is not open: it was never opened, or its bytes were refused";
        case QueryStatus::no_data:
            return "the blob was baked without what this call reads: a section, or its deformation";
        case QueryStatus::no_room:
            return "the memory is too small or has another size than the call needs, or the moving scene is full: it "
                   "has "
                   "as many instances as it was created for";
        case QueryStatus::stale_handle:
            return "the handle is stale: its instance was removed from the moving scene, or never was in it";
        case QueryStatus::not_refitted:
            return "instances were moved by a batch: call refit before the next query";
    }
    return "not a query status of this library";
}

}  // namespace espalier
