// Spheres and capsules find what they overlap by distance (proximity/).
#include <espalier/overlap.hpp>
#include <runtime/lanes/select.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/overlap/rounded_shapes.hpp>

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

QueryStatus round_volume(const BlobData& blob, const Capsule& local, Rounded<Capsule>& capsule) noexcept {
    if (!is_radius(local.radius)) return QueryStatus::invalid_argument;
    const QueryStatus status = round_segment(blob, {local.from, local.to}, capsule.segment);
    if (status != QueryStatus::ok) return status;
    prepare(capsule);
    capsule.radius = radius_in_steps(blob, local.radius);
    return QueryStatus::ok;
}

template <>
QueryStatus find_overlaps_of<Capsule>(const BlobData& blob, const void* shape, Each& answer,
                                      const WalkAccuracy& accuracy) {
    Rounded<Capsule> capsule;
    const QueryStatus status = round_volume(blob, *static_cast<const Capsule*>(shape), capsule);
    if (status != QueryStatus::ok || blob.triangle_count == 0) return status;
    const DistantShape& distant = capsule;
    return ESPALIER_DISPATCH(find_overlaps_of_capsule, blob, distant, answer, accuracy) ? QueryStatus::stopped
                                                                                        : QueryStatus::ok;
}

}  // namespace espalier::detail
