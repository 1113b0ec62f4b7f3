// What the parts of `open` share: the checks of padding, and what the pass over the nodes has seen so far.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/status.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/base/options.hpp>
#include <runtime/blob/node.hpp>
#include <runtime/blob/deformable_blob.hpp>

namespace espalier::detail {

ESPALIER_SHARED_CODE inline bool is_zero(const std::byte* bytes, std::size_t count) {
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum |= load_u8(bytes + i);
    return sum == 0;
}

/// The unused high bits of the last byte of a stream.
inline bool is_padded_with_zeros(const std::byte* stream, unsigned bit_count) {
    return bit_count % 8 == 0 || load_u8(stream + bit_count / 8) >> (bit_count % 8) == 0;
}

/// How far the pass over the nodes has come.
struct OpenProgress {
    const BlobData& blob;
    PoseBounds bounds = pose_bounds_of(blob);  ///< in which every vertex must be
    std::uint32_t triangles = 0;
    std::uint32_t leaf_bytes = 0;    ///< at most those of the section
    std::uint32_t vertex_slots = 0;  ///< of plain leaves
};

/// The leaves of a node: inside the section, every vertex inside the asset, every corner a vertex.
bool take_leaves(PackedNode node, OpenProgress& seen);
bool take_leaves(PlainNode node, OpenProgress& seen);

}  // namespace espalier::detail
