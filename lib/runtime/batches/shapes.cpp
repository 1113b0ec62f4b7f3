// Points, spheres and boxes in arrays.
#include <espalier/batches/shapes.hpp>
#include <espalier/overlap.hpp>
#include <runtime/batches/fill.hpp>

namespace espalier {

using namespace detail;

Filled closest_point(const Blob& blob, const Strided<Vec3>& points, std::span<ClosestPoint> nearest,
                     float max_distance) noexcept {
    return fill_each(check_arrays(blob, nearest.size(), points), nearest,
                     [&](std::size_t i) { return closest_point(blob, points.at(i), max_distance); });
}

Filled signed_distance(const Blob& blob, const Strided<Vec3>& points, std::span<ClosestPoint> nearest,
                       float max_distance) noexcept {
    return fill_each(check_arrays(blob, nearest.size(), points), nearest,
                     [&](std::size_t i) { return signed_distance(blob, points.at(i), max_distance); });
}

Filled contains(const Blob& blob, const Strided<Vec3>& points, std::span<YesNo> answers) noexcept {
    return fill_each(check_arrays(blob, answers.size(), points), answers,
                     [&](std::size_t i) { return contains(blob, points.at(i)); });
}

Filled closest_triangles(const Blob& blob, const Strided<Vec3>& points, std::span<ClosestPoint> nearest,
                         std::span<Filled> found, float max_distance) noexcept {
    return fill_rows(check_arrays(blob, found.size(), points), nearest, found,
                     [&](std::size_t i, std::span<ClosestPoint> row) {
                         return closest_triangles(blob, points.at(i), row, max_distance);
                     });
}

Filled overlaps(const Blob& blob, const SphereArrays& spheres, std::span<YesNo> answers) noexcept {
    return fill_each(check_arrays(blob, answers.size(), spheres.centers, spheres.radii), answers,
                     [&](std::size_t i) { return overlaps(blob, spheres.at(i)); });
}

Filled overlaps(const Blob& blob, const BoxArrays& boxes, std::span<YesNo> answers) noexcept {
    return fill_each(check_arrays(blob, answers.size(), boxes.min, boxes.max), answers,
                     [&](std::size_t i) { return overlaps(blob, boxes.at(i)); });
}

FilledLists collect_overlaps(const Blob& blob, const SphereArrays& spheres, std::span<QueryStatus> statuses,
                             std::span<std::size_t> offsets, std::span<TriangleId> triangles) noexcept {
    return fill_lists(check_arrays(blob, statuses.size(), spheres.centers, spheres.radii), statuses, offsets, triangles,
                      [&](std::size_t i, auto visit) { return for_each_overlap(blob, spheres.at(i), visit); });
}

FilledLists collect_overlaps(const Blob& blob, const BoxArrays& boxes, std::span<QueryStatus> statuses,
                             std::span<std::size_t> offsets, std::span<TriangleId> triangles) noexcept {
    return fill_lists(check_arrays(blob, statuses.size(), boxes.min, boxes.max), statuses, offsets, triangles,
                      [&](std::size_t i, auto visit) { return for_each_overlap(blob, boxes.at(i), visit); });
}

}  // namespace espalier
