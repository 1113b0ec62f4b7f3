// Which of the source's triangles was that: from a triangle or a hit of a blob back to the file, mesh and triangle that
// was baked.
//
// Two things lead back: ids in the blob (BakeOptions::original_ids), or the remap table of its bake (Baked::remap,
// `espalier bake --remap`), which costs nothing in the blob.
//
// Arguments. Any bit pattern is safe. Nothing allocates.
//
// Numbers. Of the three weights of a hit two are its u and v, unchanged. The weight of the blob's corner a is (1 - u) -
// v in float32, and 0 where that is negative. For u and v from 0 to 1 it is within 2^-24 of the exact 1 - u - v, or of
// 0 where that is negative.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/ray.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// False, and `original` untouched, when the blob carries no ids or has no such triangle. At most 127 steps from id to
/// id, then O(log(number of meshes)).
bool original_triangle(const Blob& blob, Triangle triangle, OriginalTriangle& original) noexcept;

/// Writes where each of `triangles` came from to the same place of `originals`. Any status but ok means that nothing
/// was written: not_open, no_data (baked without ids), or invalid_argument (spans of different sizes, a triangle that
/// the blob does not have).
[[nodiscard]] QueryStatus original_triangle(const Blob& blob, std::span<const Triangle> triangles,
                                            std::span<OriginalTriangle> originals) noexcept;

/// A hit in terms of the source: the triangle that was hit and the weights of its corners. Converts to true when status
/// is ok; else all fields but status are 0.
struct [[nodiscard]] OriginalHit {
    std::uint32_t file = 0;
    std::uint32_t mesh = 0;
    std::uint32_t triangle = 0;
    float u = 0.0f;  ///< barycentric weight of the source triangle's second corner
    float v = 0.0f;  ///< barycentric weight of its third corner; the first has 1 - u - v
    QueryStatus status = QueryStatus::not_open;
    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }
};

/// Returns the source's triangle of a hit that a query of `blob` returned. Status: not_found for a miss (a batch of
/// rays writes no_triangle), no_data for a blob without ids, not_open, or invalid_argument for a triangle that the blob
/// does not have. At most 127 steps from id to id, then O(log(number of meshes)).
OriginalHit original_hit(const Blob& blob, const RayHit& hit) noexcept;

/// Writes the source's triangle of each of `hits` to the same place of `originals`, where each has its own status.
/// Returns invalid_argument, and writes nothing, for spans of different sizes.
[[nodiscard]] QueryStatus original_hit(const Blob& blob, std::span<const RayHit> hits,
                                       std::span<OriginalHit> originals) noexcept;

/// Returns the source's triangle of a hit by the remap table of the blob's bake. Status: not_found for a miss,
/// invalid_argument for a triangle that the table does not have, or a first_corner above 2. O(1).
OriginalHit original_hit(std::span<const OriginalTriangle> remap, const RayHit& hit) noexcept;

/// Writes the triangles of a remap file (`bake --remap`, remap_file of bake.hpp) to `remap`, which has a place for each
/// triangle of the blob. Any bytes, any alignment. On any status but ok nothing was written: not_a_remap (also when it
/// is damaged), or other_blob for a file that belongs to another blob, and for another number of places. On a
/// little-endian machine the bytes behind the first 16 are the table as it lies in memory. O(size).
[[nodiscard]] Status read_remap(std::span<const std::byte> file, const Blob& blob,
                                std::span<OriginalTriangle> remap) noexcept;

}  // namespace espalier
