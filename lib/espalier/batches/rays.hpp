// Batches of rays whose fields lie in arrays of your own: closest hits, any hit, the first few hits, all hits and
// crossings.
//
// arrays.hpp states what every batch refuses. The number of results sets the number of queries, and each result has the
// status of its own ray. Any number of threads may query the same blob, and no call allocates.
#pragma once

#include <cstddef>
#include <span>

#include <espalier/batches/arrays.hpp>
#include <espalier/blob.hpp>
#include <espalier/ray.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// The fields of Ray, each in an array of its own.
struct RayArrays {
    Strided<Vec3> origins;
    Strided<Vec3> directions;
    Strided<float> t_min = {};  ///< if null, every t_min is 0
    Strided<float> t_max = {};  ///< if null, every t_max is infinite
    FaceCulling culling = FaceCulling::none;

    [[nodiscard]] Ray at(std::size_t query) const noexcept {
        return {origins.at(query), directions.at(query), t_min.first == nullptr ? 0.0f : t_min.at(query),
                t_max.first == nullptr ? infinity : t_max.at(query), culling};
    }
    /// Returns the rays from index `query` on.
    [[nodiscard]] RayArrays from(std::size_t query) const noexcept {
        return {origins.from(query), directions.from(query), t_min.from(query), t_max.from(query), culling};
    }
};

/// Writes what raycast() returns for each ray, as fast as the batch that takes a span of rays. The rays are never
/// copied as a whole: a few at a time are copied to up to 17 KB of stack, or hardly any on cores without SIMD.
Filled raycast(const Blob& blob, const RayArrays& rays, std::span<RayHit> hits) noexcept;

/// Writes what occluded() returns for each ray. The rules are those of raycast().
Filled occluded(const Blob& blob, const RayArrays& rays, std::span<YesNo> answers) noexcept;

/// Writes what closest_hits() returns for each ray to `found`, and the hits to rows of `hits`. hits.size() must be a
/// multiple of found.size(). Their quotient is the length of a row, so the hits of ray i begin at i * hits.size() /
/// found.size().
Filled closest_hits(const Blob& blob, const RayArrays& rays, std::span<RayHit> hits, std::span<Filled> found) noexcept;

/// Writes all hits of each ray in the order of for_each_hit(), and the status that it returns to `statuses`. `offsets`
/// must have one element more than `statuses`.
FilledLists collect_hits(const Blob& blob, const RayArrays& rays, std::span<QueryStatus> statuses,
                         std::span<std::size_t> offsets, std::span<RayHit> hits) noexcept;

/// Writes the crossings of each ray in the order of for_each_crossing(). The rules are those of collect_hits().
FilledLists collect_crossings(const Blob& blob, const RayArrays& rays, std::span<QueryStatus> statuses,
                              std::span<std::size_t> offsets, std::span<RayHit> crossings) noexcept;

}  // namespace espalier
