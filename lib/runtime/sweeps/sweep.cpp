// Sweeps in the caller's units: rounded, answered in lattice units, translated back.
#include <type_traits>

#include <espalier/sweep.hpp>
#include <runtime/sweeps/contact_time.hpp>
#include <runtime/sweeps/queries.hpp>

#define ESPALIER_FRAGMENT <runtime/sweeps/first_contact.hpp>
#include <runtime/lanes/for_each_set.hpp>

namespace espalier {

using namespace detail;

namespace {

template <class Shape>
SweepHit sweep_shape(const Blob& blob, const Shape& shape, const Vec3& displacement, const SweepOptions& options,
                     float& contact_t) {
    SweepHit hit;
    if (!blob) return hit;
    hit.status = QueryStatus::invalid_argument;
    if (!is_radius(options.skin) || !is_finite(options.skin)) return hit;
    SweepOf<Shape> rounded;
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
    if (found.tick == no_contact) return hit;
    contact_t = share_of_way(tick_before(found.tick));
    return to_sweep_hit(data_of(blob), rounded, found, radius_in_steps(data_of(blob), options.skin));
}

}  // namespace

template <SweptShape Shape>
SweepHit detail::sweep_to_contact(const Blob& blob, const Shape& shape, const Vec3& displacement,
                                  const SweepOptions& options, float& contact_t) noexcept {
    return sweep_shape(blob, shape, displacement, options, contact_t);
}
template SweepHit detail::sweep_to_contact(const Blob&, const Sphere&, const Vec3&, const SweepOptions&,
                                           float&) noexcept;
template SweepHit detail::sweep_to_contact(const Blob&, const Capsule&, const Vec3&, const SweepOptions&,
                                           float&) noexcept;
template SweepHit detail::sweep_to_contact(const Blob&, const OrientedBox&, const Vec3&, const SweepOptions&,
                                           float&) noexcept;
template SweepHit detail::sweep_to_contact(const Blob&, const ConvexHull&, const Vec3&, const SweepOptions&,
                                           float&) noexcept;

template <SweptShape Shape>
SweepHit sweep(const Blob& blob, const Shape& shape, Vec3 displacement, const SweepOptions& options) noexcept {
    float contact_t;
    if constexpr (std::is_same_v<Shape, Box>) return sweep_shape(blob, shape, displacement, options, contact_t);
    else return sweep_to_contact(blob, shape, displacement, options, contact_t);
}
template SweepHit sweep(const Blob&, const Sphere&, Vec3, const SweepOptions&) noexcept;
template SweepHit sweep(const Blob&, const Capsule&, Vec3, const SweepOptions&) noexcept;
template SweepHit sweep(const Blob&, const Box&, Vec3, const SweepOptions&) noexcept;
template SweepHit sweep(const Blob&, const OrientedBox&, Vec3, const SweepOptions&) noexcept;
template SweepHit sweep(const Blob&, const ConvexHull&, Vec3, const SweepOptions&) noexcept;

}  // namespace espalier
