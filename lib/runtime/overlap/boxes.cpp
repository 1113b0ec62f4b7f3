// Boxes, along the axes or not: how they find what they overlap.
#include <type_traits>

#include <espalier/overlap.hpp>
#include <runtime/overlap/find.hpp>
#include <runtime/overlap/rounded_shapes.hpp>

#if !ESPALIER_SMALL_CODE
#define ESPALIER_FRAGMENT <runtime/overlap/box_queries.hpp>
#include <runtime/lanes/for_each_set.hpp>
#endif

namespace espalier::detail {

namespace {

#if ESPALIER_SMALL_CODE

template <class Shape>
QueryStatus find_overlaps_of_box(const BlobData& blob, const void* shape, Each& answer, const WalkAccuracy& accuracy) {
    return find_overlaps_in_volume<Shape>(blob, shape, answer, accuracy);
}

#else

/// The faces follow where the kernel needs them.
QueryStatus round_box(const BlobData& blob, const OrientedBox& local, Rounded<OrientedBox>& box) {
    return round_half_axes(blob, local, box);
}
QueryStatus round_box(const BlobData& blob, const auto& local, Rounded<Box>& box) {
    return round_volume(blob, local, box);
}

template <class Shape>
QueryStatus find_overlaps_of_box(const BlobData& blob, const void* shape, Each& answer, const WalkAccuracy& accuracy) {
    std::conditional_t<std::is_same_v<Shape, OrientedBox>, Rounded<OrientedBox>, Rounded<Box>> box;
    const QueryStatus rounded = round_box(blob, *static_cast<const Shape*>(shape), box);
    if (rounded == QueryStatus::not_found) return QueryStatus::ok;
    if (rounded != QueryStatus::ok || blob.triangle_count == 0) return rounded;
    return ESPALIER_DISPATCH(find_triangles_in_box, blob, box, answer, accuracy) ? QueryStatus::stopped
                                                                                 : QueryStatus::ok;
}

#endif

}  // namespace

template <>
QueryStatus find_overlaps_of<OrientedBox>(const BlobData& blob, const void* shape, Each& answer,
                                          const WalkAccuracy& accuracy) {
    return find_overlaps_of_box<OrientedBox>(blob, shape, answer, accuracy);
}
template <>
QueryStatus find_overlaps_of<Box>(const BlobData& blob, const void* shape, Each& answer, const WalkAccuracy& accuracy) {
    return find_overlaps_of_box<Box>(blob, shape, answer, accuracy);
}
template <>
QueryStatus find_overlaps_of<LatticeBox>(const BlobData& blob, const void* shape, Each& answer,
                                         const WalkAccuracy& accuracy) {
    return find_overlaps_of_box<LatticeBox>(blob, shape, answer, accuracy);
}

}  // namespace espalier::detail
