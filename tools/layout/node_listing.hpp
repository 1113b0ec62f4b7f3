// The nodes of a tree, its leaves, and what a deformable blob adds, byte by byte.
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

/// From where the listing stands, which is the beginning of the block of node `node`. The blob was opened on `bytes`.
void list_leaf_block(std::span<const std::byte> bytes, const Blob& blob, std::size_t node, ByteListing& listing);

void list_corners(std::span<const std::byte> bytes, const Blob& blob, const Section& section, ByteListing& listing);
void list_vertex_sources(std::span<const std::byte> bytes, const Blob& blob, const Section& section,
                         ByteListing& listing);

}  // namespace espalier::tools
