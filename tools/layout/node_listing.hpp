// The bytes of nodes, with their meaning.
#pragma once

#include <cstddef>
#include <span>

#include <espalier/blob.hpp>

#include "blob_layout.hpp"
#include "byte_listing.hpp"

namespace espalier::tools {

/// Lists the nodes of a blob, from where the listing stands, which is their beginning.
void list_nodes(std::span<const std::byte> bytes, const Blob& blob, ByteListing& listing);

/// The words for what leaves are: those of a scene's tree are instances.
struct PackedNodeWords {
    const char* leaves;
    const char* leaf_block;
};

/// Lists one packed node, from where the listing stands.
void list_packed_node(std::span<const std::byte> bytes, const NodeFields& node, std::size_t number,
                      const PackedNodeWords& words, ByteListing& listing);

}  // namespace espalier::tools
