// What each status says to a person.
#include <espalier/status.hpp>

namespace espalier {

const char* describe(Status status) noexcept {
    switch (status) {
        case Status::ok:
            return "ok";
        case Status::too_short:
            return "the blob is cut short: there are fewer bytes than its header says, or not even a header";
        case Status::trailing_bytes:
            return "there are more bytes than the blob's header says";
        case Status::not_a_blob:
            return "these bytes are not an Espalier blob: they do not begin with ESPL";
        case Status::unsupported_version:
            return "the blob's format version is not one that this library reads: bake it again, or update the library";
        case Status::unsupported_profile:
            return "the blob uses a profile that this library does not know";
        case Status::unsupported_feature:
            return "the blob has an optional section that this library does not know";
        case Status::bad_header:
            return "a field of the blob's header is out of its range";
        case Status::bad_checksum:
            return "the blob is damaged: its checksum does not match its bytes";
        case Status::bad_node:
            return "a node of the blob breaks the format's rules";
        case Status::bad_leaf:
            return "a leaf of the blob breaks the format's rules";
        case Status::bad_section:
            return "an optional section of the blob breaks the format's rules, or bytes are left over";
        case Status::misaligned:
            return "the espalier_blob to open into lies at an address that is no multiple of 16: align it";
        case Status::not_a_remap:
            return "these bytes are not a remap file that this library reads, or they are damaged";
        case Status::other_blob:
            return "the remap file belongs to another blob, or the array has another size than it";
    }
    return "not a status of this library";
}

const char* describe(QueryStatus status) noexcept {
    switch (status) {
        case QueryStatus::ok:
            return "the whole answer";
        case QueryStatus::invalid_argument:
            return "an argument is not a number, infinite or negative where the query does not take that";
        case QueryStatus::out_of_range:
            return "an argument is too far away or too large for the lattice that the blob was baked on";
        case QueryStatus::not_closed:
            return "the blob's surface is not closed, so it has no inside";
        case QueryStatus::has_copies:
            return "the blob was baked with spatial splits and answers no enumerating queries";
        case QueryStatus::work_limit:
            return "the limit of work was reached before the answer was complete";
        case QueryStatus::output_full:
            return "the array is full and there is more to report";
        case QueryStatus::not_found:
            return "there is none";
        case QueryStatus::not_open:
            return "the blob was never opened, or was refused when it was";
        case QueryStatus::no_data:
            return "the blob was baked without the section that this query reads";
    }
    return "not a query status of this library";
}

}  // namespace espalier
