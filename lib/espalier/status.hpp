// Why a blob was refused, and why a query was. One meaning each; the numbers are stable.
#pragma once

#include <cstdint>

namespace espalier {

enum class Status : std::uint8_t {
    ok = 0,
    too_short = 1,            ///< fewer bytes than the header, or than the header says
    trailing_bytes = 2,       ///< more bytes than the header says
    not_a_blob = 3,           ///< the first four bytes are not "ESPL"
    unsupported_version = 4,  ///< another major version, or a minor version newer than this library
    unsupported_profile = 5,  ///< a profile that this library does not know, or was built without
    unsupported_feature = 6,  ///< a feature bit that this library does not know
    bad_header = 7,           ///< a header field out of its range, or two that contradict each other
    bad_checksum = 8,         ///< the bytes are not the ones that were written
    bad_node = 9,             ///< a node breaks the rules of docs/format.md
    bad_leaf = 10,            ///< a leaf breaks the rules of docs/format.md
    bad_section = 11,         ///< an optional section breaks the rules of docs/format.md
    misaligned = 13,          ///< of C alone: the address of the espalier_blob is no multiple of 16
    not_a_remap = 15,         ///< of read_remap: no remap file that this library reads, or a damaged one
    other_blob = 16,          ///< of read_remap: the remap file belongs to another blob
};

/// One English sentence without a full stop, static, never null: also for values that are no Status.
[[nodiscard]] const char* describe(Status status) noexcept;

/// What a query says that has more to say than yes or no.
enum class QueryStatus : std::uint8_t {
    ok = 0,                ///< the answer is the whole answer
    invalid_argument = 1,  ///< a NaN, an infinity or a negative size where the query's header rules them out
    out_of_range = 2,      ///< so far away or so large, in lattice steps, that the query's header rules it out
    not_closed = 3,        ///< only a blob whose closed flag is set has an inside
    has_copies = 4,        ///< a blob with copy_count() above 0 answers no enumerating queries
    work_limit = 5,        ///< the caller's limit of work was reached: the answer covers a part only
    output_full = 6,       ///< the caller's array is full and there is more
    not_found = 7,         ///< the whole answer, which is that there is none
    not_open = 8,          ///< the blob was never opened, or refused by open
    no_data = 9,           ///< the blob was baked without the section that the query reads
};

/// One English sentence without a full stop, static, never null: also for values that are no QueryStatus.
[[nodiscard]] const char* describe(QueryStatus status) noexcept;

template <class Value, class Error = QueryStatus>
class Result;

/// A value, which counts only if the status is ok.
template <class Value>
class [[nodiscard]] Result<Value, QueryStatus> {
public:
    Value value = {};
    QueryStatus status = QueryStatus::invalid_argument;

    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }
};

}  // namespace espalier
