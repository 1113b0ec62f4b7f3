// Batches of points, spheres and boxes in arrays: closest points and triangles, points inside, and overlaps.
//
// arrays.hpp states what every batch refuses. The number of results sets the number of queries, and each result has the
// status of its own query. Any number of threads may query the same blob, and no call allocates.
#pragma once

#include <cstddef>
#include <span>

#include <espalier/batches/arrays.hpp>
#include <espalier/blob.hpp>
#include <espalier/distance.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// The fields of Sphere, each in an array of its own.
struct SphereArrays {
    Strided<Vec3> centers;
    Strided<float> radii;

    [[nodiscard]] Sphere at(std::size_t query) const noexcept { return {centers.at(query), radii.at(query)}; }
    /// Returns the spheres from index `query` on.
    [[nodiscard]] SphereArrays from(std::size_t query) const noexcept {
        return {centers.from(query), radii.from(query)};
    }
};

/// The fields of Box, each in an array of its own.
struct BoxArrays {
    Strided<Vec3> min;
    Strided<Vec3> max;

    [[nodiscard]] Box at(std::size_t query) const noexcept { return {min.at(query), max.at(query)}; }
    /// Returns the boxes from index `query` on.
    [[nodiscard]] BoxArrays from(std::size_t query) const noexcept { return {min.from(query), max.from(query)}; }
};

/// Writes what closest_point() returns for each point.
Filled closest_point(const Blob& blob, const Strided<Vec3>& points, std::span<ClosestPoint> nearest,
                     float max_distance = infinity) noexcept;

/// Writes what signed_distance() returns for each point.
Filled signed_distance(const Blob& blob, const Strided<Vec3>& points, std::span<ClosestPoint> nearest,
                       float max_distance = infinity) noexcept;

/// Writes what contains() returns for each point.
Filled contains(const Blob& blob, const Strided<Vec3>& points, std::span<YesNo> answers) noexcept;

/// Writes what closest_triangles() returns for each point to `found`, and the triangles to rows of `nearest`.
/// nearest.size() must be a multiple of found.size(). Their quotient is the length of a row, so the triangles of point
/// i begin at i * nearest.size() / found.size().
Filled closest_triangles(const Blob& blob, const Strided<Vec3>& points, std::span<ClosestPoint> nearest,
                         std::span<Filled> found, float max_distance = infinity) noexcept;

/// Writes what overlaps() returns for each shape.
Filled overlaps(const Blob& blob, const SphereArrays& spheres, std::span<YesNo> answers) noexcept;
Filled overlaps(const Blob& blob, const BoxArrays& boxes, std::span<YesNo> answers) noexcept;

/// Writes the triangles that touch each shape in the order of for_each_overlap(), and the status that it returns to
/// `statuses`. `offsets` must have one element more than `statuses`.
FilledLists collect_overlaps(const Blob& blob, const SphereArrays& spheres, std::span<QueryStatus> statuses,
                             std::span<std::size_t> offsets, std::span<TriangleId> triangles) noexcept;
FilledLists collect_overlaps(const Blob& blob, const BoxArrays& boxes, std::span<QueryStatus> statuses,
                             std::span<std::size_t> offsets, std::span<TriangleId> triangles) noexcept;

}  // namespace espalier
