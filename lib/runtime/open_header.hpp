// What both ways of opening a blob begin with. Nothing but the header is believed, nothing outside the bytes is read.
#pragma once

#include <cstddef>

#include <espalier/blob.hpp>
#include <espalier/status.hpp>

namespace espalier::detail {

/// What the bytes must be before anything else in them has a meaning; the checksum is read and not compared.
Status read_version_and_size(const std::byte* bytes, std::size_t size, BlobData& blob);
/// The rest of the header, each rule of it, and where by that the sections are.
Status read_header(BlobData& blob);
/// Points at each section, which together are the blob, without a look at what is in them: but for the number of
/// copies and, where asked, the zero bits that sections end with.
Status locate_sections(BlobData& blob, bool looks_at_padding);

/// Apart, so that small cores have the code once.
[[gnu::noinline]] void make_empty(Blob& blob);

}  // namespace espalier::detail
