// Volumes in the caller's units: rounded, answered in lattice units. Spheres have lanes of their own for what is asked
// most; all else goes the same way for every shape.
#include <espalier/lattice.hpp>
#include <espalier/overlap.hpp>
#include <runtime/lattice_box.hpp>
#include <runtime/lattice_capsule.hpp>
#include <runtime/lattice_corners.hpp>
#include <runtime/lattice_half_spaces.hpp>
#include <runtime/lattice_oriented_box.hpp>
#include <runtime/lattice_round.hpp>
#include <runtime/point_queries.hpp>
#include <runtime/simd/dispatch.hpp>

namespace espalier {

using namespace detail;

static_assert(max_planes == Volume::max_planes);

namespace {

template <class Rounded, class Shape>
bool any_in(const Blob& blob, const Shape& shape) {
    Rounded volume;
    if (blob.triangle_count() == 0 || round_volume(blob.data(), shape, volume) != QueryStatus::ok) return false;
    return !volume.is_empty && !visit_triangles_in(blob.data(), volume, 0, [](Triangle) { return stop; });
}

template <class Rounded, class Shape>
bool each_in(const Blob& blob, const Shape& shape, FunctionRef<Visit(Triangle)> visit) {
    if (blob.copy_count() != 0) return false;
    if (blob.triangle_count() == 0) return true;
    Rounded volume;
    const QueryStatus status = round_volume(blob.data(), shape, volume);
    if (status != QueryStatus::ok) return status == QueryStatus::invalid_argument;
    return volume.is_empty || visit_triangles_in(blob.data(), volume, 0, visit);
}

/// Fills a page with what the walk visits.
struct PageMaker {
    std::span<Triangle> out;
    OverlapPage page;

    Visit operator()(Triangle triangle) {
        if (page.count == out.size()) {
            page.status = QueryStatus::output_full;
            page.next = triangle.index;
            return stop;
        }
        out[page.count++] = triangle;
        return keep_going;
    }
};

template <class Rounded, class Shape>
OverlapPage page_in(const Blob& blob, const Shape& shape, std::span<Triangle> out, std::uint32_t first) {
    Rounded volume;
    if (blob.copy_count() != 0) return {QueryStatus::has_copies, 0, first};
    const QueryStatus status = round_volume(blob.data(), shape, volume);
    if (status != QueryStatus::ok) return {status, 0, first};
    PageMaker maker = {out, {QueryStatus::ok, 0, blob.triangle_count()}};
    if (blob.triangle_count() != 0 && !volume.is_empty) visit_triangles_in(blob.data(), volume, first, maker);
    return maker.page;
}

using HalfSpaces = std::span<const Plane>;

}  // namespace

bool overlaps(const Blob& blob, const Sphere& sphere) noexcept {
    LatticePoint rounded;
    return blob.triangle_count() != 0 && round_point(blob.data(), sphere.center, sphere.radius, rounded) &&
           ESPALIER_DISPATCH(any_overlap, blob.data(), rounded);
}
bool overlaps(const Blob& blob, const Capsule& capsule) noexcept { return any_in<LatticeCapsule>(blob, capsule); }
bool overlaps(const Blob& blob, const Box& box) noexcept { return any_in<LatticeBox>(blob, box); }
bool overlaps(const Blob& blob, const BoxInSteps& box) noexcept { return any_in<LatticeBox>(blob, box); }
bool overlaps(const Blob& blob, const OrientedBox& box) noexcept { return any_in<LatticeOrientedBox>(blob, box); }
bool overlaps(const Blob& blob, const Corners& triangle) noexcept { return any_in<LatticeCorners>(blob, triangle); }
bool overlaps(const Blob& blob, HalfSpaces planes) noexcept { return any_in<LatticeHalfSpaces>(blob, planes); }

bool for_each_overlap(const Blob& blob, const Sphere& sphere, FunctionRef<Visit(Triangle)> visit) {
    LatticePoint rounded;
    if (blob.copy_count() != 0) return false;
    if (blob.triangle_count() == 0 || !round_point(blob.data(), sphere.center, sphere.radius, rounded)) return true;
    return ESPALIER_DISPATCH(every_overlap, blob.data(), rounded, 0, visit);
}
bool for_each_overlap(const Blob& blob, const Capsule& capsule, FunctionRef<Visit(Triangle)> visit) {
    return each_in<LatticeCapsule>(blob, capsule, visit);
}
bool for_each_overlap(const Blob& blob, const Box& box, FunctionRef<Visit(Triangle)> visit) {
    return each_in<LatticeBox>(blob, box, visit);
}
bool for_each_overlap(const Blob& blob, const BoxInSteps& box, FunctionRef<Visit(Triangle)> visit) {
    return each_in<LatticeBox>(blob, box, visit);
}
bool for_each_overlap(const Blob& blob, const OrientedBox& box, FunctionRef<Visit(Triangle)> visit) {
    return each_in<LatticeOrientedBox>(blob, box, visit);
}
bool for_each_overlap(const Blob& blob, const Corners& triangle, FunctionRef<Visit(Triangle)> visit) {
    return each_in<LatticeCorners>(blob, triangle, visit);
}
bool for_each_overlap(const Blob& blob, HalfSpaces planes, FunctionRef<Visit(Triangle)> visit) {
    return each_in<LatticeHalfSpaces>(blob, planes, visit);
}

OverlapPage collect_overlaps(const Blob& blob, const Sphere& sphere, std::span<Triangle> out,
                             std::uint32_t first) noexcept {
    if (blob.copy_count() != 0) return {QueryStatus::has_copies, 0, first};
    if (!is_finite(sphere.center) || !is_radius(sphere.radius)) return {QueryStatus::invalid_argument, 0, first};
    PageMaker maker = {out, {QueryStatus::ok, 0, blob.triangle_count()}};
    LatticePoint rounded;
    if (blob.triangle_count() != 0 && round_point(blob.data(), sphere.center, sphere.radius, rounded))
        ESPALIER_DISPATCH(every_overlap, blob.data(), rounded, first, maker);
    return maker.page;
}
OverlapPage collect_overlaps(const Blob& blob, const Capsule& capsule, std::span<Triangle> out,
                             std::uint32_t first) noexcept {
    return page_in<LatticeCapsule>(blob, capsule, out, first);
}
OverlapPage collect_overlaps(const Blob& blob, const Box& box, std::span<Triangle> out, std::uint32_t first) noexcept {
    return page_in<LatticeBox>(blob, box, out, first);
}
OverlapPage collect_overlaps(const Blob& blob, const BoxInSteps& box, std::span<Triangle> out,
                             std::uint32_t first) noexcept {
    return page_in<LatticeBox>(blob, box, out, first);
}
OverlapPage collect_overlaps(const Blob& blob, const OrientedBox& box, std::span<Triangle> out,
                             std::uint32_t first) noexcept {
    return page_in<LatticeOrientedBox>(blob, box, out, first);
}
OverlapPage collect_overlaps(const Blob& blob, const Corners& triangle, std::span<Triangle> out,
                             std::uint32_t first) noexcept {
    return page_in<LatticeCorners>(blob, triangle, out, first);
}
OverlapPage collect_overlaps(const Blob& blob, HalfSpaces planes, std::span<Triangle> out,
                             std::uint32_t first) noexcept {
    return page_in<LatticeHalfSpaces>(blob, planes, out, first);
}

}  // namespace espalier
