// The beginning of open() and open_unchecked(). Nothing but the header is trusted, nothing outside the bytes is read.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/base/compiler.hpp>
#include <espalier/status.hpp>

namespace espalier::detail {

/// What the first fields of a file of this library must be.
struct FileKind {
    std::uint32_t magic;
    std::uint16_t version_major;
    std::uint16_t version_minor;
    OpenStatus refusal;  ///< of bytes with another magic
};
inline constexpr FileKind blob_file = {format::magic, format::version_major, format::version_minor,
                                       OpenStatus::not_a_blob};

/// Reads the fields that give the others a meaning: magic, version, size. The checksum is read and not compared.
OpenStatus read_version_and_size(const std::byte* bytes, std::size_t size, BlobData& blob,
                                 const FileKind& kind = blob_file);
/// Reads the step, the origin, the extent and the largest error, which scenes have at the same places. Requires the
/// bits; returns whether all are within their ranges.
bool read_lattice(BlobData& blob);
/// Reads the rest of the header, checks each rule of it, and locates the sections.
OpenStatus read_header(BlobData& blob);
/// Sets the pointers to the sections, which together are the blob. Of their contents it reads only the number of copies
/// and, if `looks_at_padding`, the zero bits that sections end with.
OpenStatus locate_sections(BlobData& blob, bool looks_at_padding);

/// Makes the blob empty and stores why. Out of line, so that small cores have the code once.
ESPALIER_NOINLINE void refuse(BlobData& blob, OpenStatus status);

}  // namespace espalier::detail
