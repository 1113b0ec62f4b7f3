// Sweeps in the caller's units: rounded, answered in lattice units, translated back.
#include <type_traits>

#include <espalier/sweep.hpp>
#include <runtime/sweeps/queries.hpp>

namespace espalier {

using namespace detail;

namespace {

template <class Sweep, class Shape>
SweepHit sweep_shape(const Blob& blob, const Shape& shape, const Vec3& displacement, const SweepOptions& options) {
    SweepHit hit;
    if (!blob) return hit;
    hit.status = QueryStatus::invalid_argument;
    if (!is_radius(options.skin) || !is_finite(options.skin)) return hit;
    Sweep rounded;
    hit.status = round_sweep(data_of(blob), shape, displacement, rounded);
    if (hit.status != QueryStatus::ok) return hit;
    hit.t = 1.0f;
    hit.status = QueryStatus::not_found;
    if constexpr (std::is_same_v<Shape, Box>)
        if (is_empty(shape)) return hit;
    if constexpr (std::is_same_v<Shape, ConvexHull>)
        if (shape.vertices.empty()) return hit;
    if (blob.triangle_count() == 0) return hit;
    const FoundContact found = ESPALIER_DISPATCH(first_contact, data_of(blob), rounded, options);
    if (found.step == no_contact) return hit;
    return to_sweep_hit(data_of(blob), rounded, found, radius_in_steps(data_of(blob), options.skin));
}

}  // namespace

SweepHit sweep(const Blob& blob, const Sphere& sphere, Vec3 displacement, const SweepOptions& options) noexcept {
    return sweep_shape<CapsuleSweep>(blob, sphere, displacement, options);
}
SweepHit sweep(const Blob& blob, const Capsule& capsule, Vec3 displacement, const SweepOptions& options) noexcept {
    return sweep_shape<CapsuleSweep>(blob, capsule, displacement, options);
}
SweepHit sweep(const Blob& blob, const Box& box, Vec3 displacement, const SweepOptions& options) noexcept {
    return sweep_shape<BoxSweep>(blob, box, displacement, options);
}
SweepHit sweep(const Blob& blob, const OrientedBox& box, Vec3 displacement, const SweepOptions& options) noexcept {
    return sweep_shape<HullSweep>(blob, box, displacement, options);
}
SweepHit sweep(const Blob& blob, const ConvexHull& hull, Vec3 displacement, const SweepOptions& options) noexcept {
    return sweep_shape<HullSweep>(blob, hull, displacement, options);
}

}  // namespace espalier
