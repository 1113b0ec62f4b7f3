// The bytes of a node's leaves, with their meaning.
#pragma once

#include <cstddef>
#include <span>

#include <espalier/blob.hpp>

#include "byte_listing.hpp"

namespace espalier::tools {

/// From where the listing stands, which is the beginning of the block of node `node`. The blob was opened on `bytes`.
void list_leaf_block(std::span<const std::byte> bytes, const Blob& blob, std::size_t node, ByteListing& listing);

}  // namespace espalier::tools
