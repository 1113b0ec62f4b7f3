// Why a blob was refused. One meaning each; the numbers are stable.
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
};

/// One English sentence without a full stop, static, never null: also for values that are no Status.
[[nodiscard]] const char* describe(Status status) noexcept;

}  // namespace espalier
