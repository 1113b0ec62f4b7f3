// What both ways of opening a blob begin with. Nothing but the header is believed, nothing outside the bytes is read.
#pragma once

#include <cstddef>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/status.hpp>

namespace espalier::detail {

/// What the bytes must be before anything else in them has a meaning; the checksum is read and not compared.
Status read_version_and_size(std::span<const std::byte> bytes, BlobData& blob);
/// The rest of the header, each rule of it.
Status read_fields(BlobData& blob);
/// Points at each section, which together are the blob, without a look at what is in them: but for the number of
/// copies.
Status locate_sections(BlobData& blob);

/// Apart, so that small cores have the code once.
[[gnu::noinline]] void make_empty(Blob& blob);

}  // namespace espalier::detail
