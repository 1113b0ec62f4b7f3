// Maps a triangle or a hit back to its source: the file, mesh and triangle that were baked.
//
// There are two ways: ids that are stored in the blob (BakeOptions::original_ids), or the remap table of its bake
// (BakeResult::remap, `espalier bake --remap`), which takes no bytes in the blob. Every bit pattern is a safe argument.
// Any number of threads may query the same blob, and no call allocates. Numerics are described at the end of this file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/ray.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// Returns the source of a triangle.
///
/// The status is ok; not_open; no_data (baked without ids); not_found for no_triangle; or invalid_argument for a
/// triangle that the blob does not have. Cost: at most 32 steps from id to id, then O(log(number of meshes)).
Result<OriginalTriangle> original_triangle(const Blob& blob, TriangleId triangle) noexcept;

/// Writes the source of each of `triangles` to the same index of `originals`, each with its own status.
///
/// Returns the number of results. The status is ok; not_open or no_data if every result has it; or invalid_argument if
/// the sizes of the spans differ, in which case nothing is written.
Filled original_triangle(const Blob& blob, std::span<const TriangleId> triangles,
                         std::span<Result<OriginalTriangle>> originals) noexcept;

/// A hit in terms of the source: the triangle that was hit and the weights of its corners. Converts to true if the
/// status is ok; otherwise all other fields are 0.
struct [[nodiscard]] OriginalHit {
    std::uint32_t file = 0;
    std::uint32_t mesh = 0;
    std::uint32_t triangle = 0;
    float u = 0.0f;  ///< barycentric weight of the source triangle's second corner
    float v = 0.0f;  ///< barycentric weight of the third corner; that of the first is 1 - u - v
    QueryStatus status = QueryStatus::not_open;
    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }
};

/// Returns the source of a hit that a query on `blob` returned.
///
/// The status is ok; not_open; no_data (baked without ids); not_found for a miss; or invalid_argument for a triangle
/// that the blob does not have. The cost is that of original_triangle().
OriginalHit original_hit(const Blob& blob, const RayHit& hit) noexcept;

/// Writes the source of each of `hits` to the same index of `originals`, each with its own status. Returns what
/// original_triangle() of spans does.
Filled original_hit(const Blob& blob, std::span<const RayHit> hits, std::span<OriginalHit> originals) noexcept;

/// Returns the source of a hit from the remap table of the blob's bake. The status is ok; not_found for a miss; or
/// invalid_argument for a triangle that the table does not have, or whose first_corner is above 2. O(1).
OriginalHit original_hit(std::span<const OriginalTriangle> remap, const RayHit& hit) noexcept;

/// Writes the triangles of a remap file (`bake --remap`, or remap_file() of bake.hpp) to `remap`, which must have one
/// element for each triangle of the blob. The file may contain any bytes, at any alignment.
///
/// If the status is not ok, nothing was written: not_a_remap means that the file is no remap file or is damaged;
/// other_blob that it belongs to another blob or that `remap` has another size. On a little-endian machine the bytes of
/// the file after the first 16 are the table as it lies in memory. O(size).
OpenStatus read_remap(std::span<const std::byte> file, const Blob& blob, std::span<OriginalTriangle> remap) noexcept;

}  // namespace espalier

// Numerics. Two of the three weights of an original hit are the u and v of the hit, unchanged. The weight of the blob's
// corner a is (1 - u) - v in float32, or 0 if that is negative. For u and v from 0 to 1 it is within 2^-24 of the exact
// 1 - u - v, or of 0 if that is negative.
