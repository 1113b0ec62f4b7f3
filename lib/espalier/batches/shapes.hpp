// Batches of points, spheres and boxes in arrays: closest points and triangles, inside, overlaps.
//
// arrays.hpp has what all batches refuse. Each result has the status of its query; a batch is as long as its results.
// Thread safety: any number of threads may query one blob. No call allocates.
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

/// Spheres in arrays: the fields of Sphere.
struct SphereArrays {
    Strided<Vec3> centers;
    Strided<float> radii;

    [[nodiscard]] Sphere at(std::size_t query) const noexcept { return {centers.at(query), radii.at(query)}; }
    /// Returns the spheres from one on.
    [[nodiscard]] SphereArrays from(std::size_t query) const noexcept {
        return {centers.from(query), radii.from(query)};
    }
};

/// Boxes in arrays: the fields of Box.
struct BoxArrays {
    Strided<Vec3> min;
    Strided<Vec3> max;

    [[nodiscard]] Box at(std::size_t query) const noexcept { return {min.at(query), max.at(query)}; }
    /// Returns the boxes from one on.
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

/// Writes what closest_triangles() returns for each point to `found`, and the triangles to rows of `nearest`: that of
/// point i begins at i * places, where `places` is nearest.size() / found.size(). nearest.size() must be
/// a multiple of found.size().
Filled closest_triangles(const Blob& blob, const Strided<Vec3>& points, std::span<ClosestPoint> nearest,
                         std::span<Filled> found, float max_distance = infinity) noexcept;

/// Writes what overlaps() returns for each shape.
Filled overlaps(const Blob& blob, const SphereArrays& spheres, std::span<YesNo> answers) noexcept;
Filled overlaps(const Blob& blob, const BoxArrays& boxes, std::span<YesNo> answers) noexcept;

/// Writes the triangles that touch each shape as for_each_overlap() visits them, and what that returns to `statuses`.
/// `offsets` has one place more.
FilledLists collect_overlaps(const Blob& blob, const SphereArrays& spheres, std::span<QueryStatus> statuses,
                             std::span<std::size_t> offsets, std::span<TriangleId> triangles) noexcept;
FilledLists collect_overlaps(const Blob& blob, const BoxArrays& boxes, std::span<QueryStatus> statuses,
                             std::span<std::size_t> offsets, std::span<TriangleId> triangles) noexcept;

}  // namespace espalier
