// Spheres find what they overlap by lanes of their own (proximity/point_search.hpp).
#include <espalier/overlap.hpp>
#include <runtime/lanes/select.hpp>
#include <runtime/proximity/queries.hpp>

namespace espalier::detail {

template <>
QueryStatus find_overlaps_of<Sphere>(const BlobData& blob, const void* shape, Each& answer,
                                     const WalkAccuracy& accuracy) {
    const auto& sphere = *static_cast<const Sphere*>(shape);
    RoundedPoint rounded;
    const QueryStatus status = round_point(blob, sphere.center, sphere.radius, rounded);
    if (is_refused(status)) return status;
    if (status == QueryStatus::not_found || blob.triangle_count == 0) return QueryStatus::ok;
    return ESPALIER_DISPATCH(find_overlaps, blob, rounded, answer, accuracy) ? QueryStatus::stopped : QueryStatus::ok;
}

}  // namespace espalier::detail
