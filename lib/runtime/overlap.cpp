// Volumes in the caller's units: rounded, answered in lattice units. Spheres have lanes of their own for what is asked
// most; all else goes the same way for every shape.
#include <espalier/lattice.hpp>
#include <espalier/overlap.hpp>
#include <runtime/closest_pair.hpp>
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

/// The triangles from storage index `first` on that a shape overlaps, in storage order. `has_seen_all` is written with
/// ok alone: false when the visitor stopped it.
using VisitOverlaps = QueryStatus (*)(const BlobData& blob, const void* shape, std::uint32_t first,
                                      FunctionRef<Visit(Triangle)> visit, bool& has_seen_all);

template <class Rounded, class Shape>
QueryStatus visit_overlaps(const BlobData& blob, const void* shape, std::uint32_t first,
                           FunctionRef<Visit(Triangle)> visit, bool& has_seen_all) {
    Rounded volume;
    const QueryStatus status = round_volume(blob, *static_cast<const Shape*>(shape), volume);
    if (status != QueryStatus::ok) return status;
    has_seen_all = blob.triangle_count == 0 || volume.is_empty || visit_triangles_in(blob, volume, first, visit);
    return QueryStatus::ok;
}

QueryStatus visit_sphere_overlaps(const BlobData& blob, const void* shape, std::uint32_t first,
                                  FunctionRef<Visit(Triangle)> visit, bool& has_seen_all) {
    const auto& sphere = *static_cast<const Sphere*>(shape);
    if (!is_finite(sphere.center) || !is_radius(sphere.radius)) return QueryStatus::invalid_argument;
    LatticePoint rounded;
    has_seen_all = blob.triangle_count == 0 || !round_point(blob, sphere.center, sphere.radius, rounded) ||
                   ESPALIER_DISPATCH(every_overlap, blob, rounded, first, visit);
    return QueryStatus::ok;
}

/// By the distance from its axis, as closest_to_segment asks: for where code is dearer than time.
[[maybe_unused]] QueryStatus visit_capsule_overlaps(const BlobData& blob, const void* shape, std::uint32_t first,
                                                    FunctionRef<Visit(Triangle)> visit, bool& has_seen_all) {
    const auto& capsule = *static_cast<const Capsule*>(shape);
    if (!is_radius(capsule.radius)) return QueryStatus::invalid_argument;
    DistantSegment rounded;
    const QueryStatus status = round_segment(blob, {capsule.from, capsule.to}, rounded.segment);
    if (status != QueryStatus::ok) return status;
    rounded.radius = radius_in_steps(blob, capsule.radius);
    prepare(rounded);
    has_seen_all = blob.triangle_count == 0 || visit_triangles_within(blob, rounded, first, visit);
    return QueryStatus::ok;
}

using HalfSpaces = std::span<const Plane>;

// How each shape is asked about.
constexpr VisitOverlaps way_of(const Sphere*) { return visit_sphere_overlaps; }
constexpr VisitOverlaps way_of(const Capsule*) {
    if constexpr (small_code) return visit_capsule_overlaps;
    else return visit_overlaps<LatticeCapsule, Capsule>;
}
constexpr VisitOverlaps way_of(const Box*) { return visit_overlaps<LatticeBox, Box>; }
constexpr VisitOverlaps way_of(const BoxInSteps*) { return visit_overlaps<LatticeBox, BoxInSteps>; }
constexpr VisitOverlaps way_of(const OrientedBox*) { return visit_overlaps<LatticeOrientedBox, OrientedBox>; }
constexpr VisitOverlaps way_of(const Corners*) { return visit_overlaps<LatticeCorners, Corners>; }
constexpr VisitOverlaps way_of(const HalfSpaces*) { return visit_overlaps<LatticeHalfSpaces, HalfSpaces>; }

bool any_in(const Blob& blob, const void* shape, VisitOverlaps way) {
    bool has_seen_all = true;
    return blob.triangle_count() != 0 &&
           way(
               blob.data(), shape, 0, [](Triangle) { return stop; }, has_seen_all) == QueryStatus::ok &&
           !has_seen_all;
}

bool each_in(const Blob& blob, const void* shape, VisitOverlaps way, FunctionRef<Visit(Triangle)> visit) {
    if (blob.copy_count() != 0) return false;
    if (blob.triangle_count() == 0) return true;
    bool has_seen_all = true;
    const QueryStatus status = way(blob.data(), shape, 0, visit, has_seen_all);
    return status == QueryStatus::ok ? has_seen_all : status == QueryStatus::invalid_argument;
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

OverlapPage page_in(const Blob& blob, const void* shape, VisitOverlaps way, std::span<Triangle> out,
                    std::uint32_t first) {
    if (blob.copy_count() != 0) return {QueryStatus::has_copies, 0, first};
    PageMaker maker = {out, {QueryStatus::ok, 0, blob.triangle_count()}};
    bool has_seen_all = true;
    const QueryStatus status = way(blob.data(), shape, first, maker, has_seen_all);
    if (status != QueryStatus::ok) return {status, 0, first};
    return maker.page;
}

}  // namespace

bool overlaps(const Blob& blob, const Sphere& sphere) noexcept {
    if constexpr (small_code) return any_in(blob, &sphere, way_of(&sphere));
    LatticePoint rounded;
    return blob.triangle_count() != 0 && round_point(blob.data(), sphere.center, sphere.radius, rounded) &&
           ESPALIER_DISPATCH(any_overlap, blob.data(), rounded);
}

// The calls of the interface, for each shape.
#define ESPALIER_EACH_AND_PAGE(Shape)                                                          \
    bool for_each_overlap(const Blob& blob, Shape shape, FunctionRef<Visit(Triangle)> visit) { \
        return each_in(blob, &shape, way_of(&shape), visit);                                   \
    }                                                                                          \
    OverlapPage collect_overlaps(const Blob& blob, Shape shape, std::span<Triangle> out,       \
                                 std::uint32_t first) noexcept {                               \
        return page_in(blob, &shape, way_of(&shape), out, first);                              \
    }
#define ESPALIER_OVERLAP_QUERIES(Shape)                                                                    \
    bool overlaps(const Blob& blob, Shape shape) noexcept { return any_in(blob, &shape, way_of(&shape)); } \
    ESPALIER_EACH_AND_PAGE(Shape)

ESPALIER_EACH_AND_PAGE(const Sphere&)
ESPALIER_OVERLAP_QUERIES(const Capsule&)
ESPALIER_OVERLAP_QUERIES(const Box&)
ESPALIER_OVERLAP_QUERIES(const BoxInSteps&)
ESPALIER_OVERLAP_QUERIES(const OrientedBox&)
ESPALIER_OVERLAP_QUERIES(const Corners&)
ESPALIER_OVERLAP_QUERIES(HalfSpaces)

#undef ESPALIER_OVERLAP_QUERIES
#undef ESPALIER_EACH_AND_PAGE

}  // namespace espalier
