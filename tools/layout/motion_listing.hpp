// The sections of a deformable blob that do not move, as a listing: corners and vertex sources.
#pragma once

#include <span>

#include <espalier/blob.hpp>

#include "blob_layout.hpp"
#include "byte_listing.hpp"

namespace espalier::tools {

void list_corners(std::span<const std::byte> bytes, const Blob& blob, const Section& section, ByteListing& listing);
void list_vertex_sources(std::span<const std::byte> bytes, const Blob& blob, const Section& section,
                         ByteListing& listing);

}  // namespace espalier::tools
