// Batches of rays in arrays: closest hits, any hit, the first few hits, all hits and crossings.
//
// arrays.hpp has what all batches refuse. Each result has the status of its ray; a batch is as long as its results.
// Thread safety: any number of threads may query one blob. No call allocates.
#pragma once

#include <cstddef>
#include <span>

#include <espalier/batches/arrays.hpp>
#include <espalier/blob.hpp>
#include <espalier/ray.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// Rays in arrays: the fields of Ray.
struct RayArrays {
    Strided<Vec3> origins;
    Strided<Vec3> directions;
    Strided<float> t_min = {};  ///< null: 0 for all
    Strided<float> t_max = {};  ///< null: infinity for all
    FaceCulling culling = FaceCulling::none;

    [[nodiscard]] Ray at(std::size_t query) const noexcept {
        return {origins.at(query), directions.at(query), t_min.first == nullptr ? 0.0f : t_min.at(query),
                t_max.first == nullptr ? infinity : t_max.at(query), culling};
    }
    /// Returns the rays from one on.
    [[nodiscard]] RayArrays from(std::size_t query) const noexcept {
        return {origins.from(query), directions.from(query), t_min.from(query), t_max.from(query), culling};
    }
};

/// Writes what raycast() returns for each ray. As fast as raycast() of a span of rays, which are never copied as a
/// whole: some at a time, on up to 17 KB of stack, but hardly any on cores without SIMD.
Filled raycast(const Blob& blob, const RayArrays& rays, std::span<RayHit> hits) noexcept;

/// Writes what occluded() returns for each ray. Same rules as raycast().
Filled occluded(const Blob& blob, const RayArrays& rays, std::span<YesNo> answers) noexcept;

/// Writes what closest_hits() returns for each ray to `found`, and the hits to rows of `hits`: that of ray i begins at
/// i * places, where `places` is hits.size() / found.size(). hits.size() must be a
/// multiple of found.size().
Filled closest_hits(const Blob& blob, const RayArrays& rays, std::span<RayHit> hits, std::span<Filled> found) noexcept;

/// Writes the hits of each ray as for_each_hit() visits them, and what that returns to `statuses`. `offsets` has one
/// place more.
FilledLists collect_hits(const Blob& blob, const RayArrays& rays, std::span<QueryStatus> statuses,
                         std::span<std::size_t> offsets, std::span<RayHit> hits) noexcept;

/// Writes the crossings of each ray as for_each_crossing() visits them. Otherwise as collect_hits().
FilledLists collect_crossings(const Blob& blob, const RayArrays& rays, std::span<QueryStatus> statuses,
                              std::span<std::size_t> offsets, std::span<RayHit> crossings) noexcept;

}  // namespace espalier
