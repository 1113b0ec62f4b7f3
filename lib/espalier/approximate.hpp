// Queries that may err by as much as you allow, on the safe side. A walk that reaches a box of the tree whose largest
// side is at most `accuracy` (world units) takes the box for the surface in it and goes no deeper: every box holds
// some. That saves most where the surface is finer than what is asked for, from far away or for sound and plans.
//
// Never missed: what overlaps, occludes or is as near as that is always reported so. A yes that the exact query would
// not give means that the surface comes within accuracy * sqrt(3) of the shape or ray as rounded (of a sphere 2^-18 of
// its radius more), and of a Box within accuracy along every axis.
// Accuracy. 0, and below or NaN, gives the exact answer. Boxes end at whole lattice steps, and leaves are not split
// further: an accuracy far below the size of a leaf costs time and gains nothing.
// Arguments otherwise, copies and safety: as in overlap.hpp, nearest.hpp and ray.hpp. The same bits on every machine.
#pragma once

#include <espalier/blob.hpp>
#include <espalier/ray.hpp>
#include <espalier/shapes.hpp>
#include <espalier/statistics.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// Whether the surface may overlap the shape. Each of these queries adds its work to `counters` where there are some.
[[nodiscard]] bool may_overlap(const Blob& blob, const Sphere& sphere, float accuracy,
                               QueryCounters* counters = nullptr) noexcept;
[[nodiscard]] bool may_overlap(const Blob& blob, const Box& box, float accuracy,
                               QueryCounters* counters = nullptr) noexcept;

/// Whether the ray may hit something. Looks at no faces where it stops at boxes: ray.faces decides for triangles only.
[[nodiscard]] bool may_be_occluded(const Blob& blob, const Ray& ray, float accuracy,
                                   QueryCounters* counters = nullptr) noexcept;

/// The distance of the surface is surely at least `lower` and at most `upper`. They differ by at most accuracy *
/// sqrt(3), and by 2^-16 of the distance.
struct DistanceBounds {
    float lower = 0.0f;
    float upper = 0.0f;
};

/// Bounds of the distance from `point` to the surface. False, and `bounds` untouched, when nothing is within
/// max_distance. Where `upper` is above max_distance something may or may not be within it.
bool distance_bounds(const Blob& blob, Vec3 point, float max_distance, float accuracy, DistanceBounds& bounds,
                     QueryCounters* counters = nullptr) noexcept;

}  // namespace espalier
