// The bytes of a blob, with their meaning.
#pragma once

#include <cstddef>
#include <span>

#include <espalier/blob.hpp>

#include "byte_listing.hpp"

namespace espalier::tools {

/// Lists the header of a blob, as far as there are bytes.
void list_blob_header(std::span<const std::byte> bytes, ByteListing& listing);

/// Lists every byte of a blob, from where the listing stands. The blob was opened on `bytes`.
void list_blob(std::span<const std::byte> bytes, const Blob& blob, ByteListing& listing);

}  // namespace espalier::tools
