// Inside or outside in the caller's units.
#include <espalier/distance.hpp>
#include <runtime/lattice/round_point.hpp>
#include <runtime/proximity/winding.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Returns ok, or why the blob or the point has no inside.
QueryStatus refusal(const Blob& blob, const Vec3& point) {
    if (!blob) return QueryStatus::not_open;
    if (!blob.is_closed()) return QueryStatus::not_closed;
    return is_finite(point) ? QueryStatus::ok : QueryStatus::invalid_argument;
}

/// Returns a closest point that is none, with the reason.
ClosestPoint nothing_near(QueryStatus status) {
    ClosestPoint nothing;
    nothing.status = status;
    return nothing;
}

Winding winding_around(const BlobData& blob, const RoundedPoint& point) {
    WindingRay ray;
    return shortest_way_out(blob, point, ray) ? winding_number(blob, ray) : Winding{};
}

}  // namespace

YesNo contains(const Blob& blob, Vec3 point) noexcept {
    if (const QueryStatus status = refusal(blob, point); status != QueryStatus::ok) return YesNo(status);
    RoundedPoint rounded;
    return YesNo::of(round_point(data_of(blob), point, infinity, rounded) == QueryStatus::ok &&
                     winding_around(data_of(blob), rounded).is_inside());
}

ClosestPoint signed_distance(const Blob& blob, Vec3 point, float max_distance) noexcept {
    const QueryStatus status = refusal(blob, point);
    // Built where the caller keeps it: a second one would be on the stack during the walk.
    ClosestPoint nearest = status == QueryStatus::ok ? closest_point(blob, point, max_distance) : nothing_near(status);
    if (is_refused(nearest.status)) return nearest;
    RoundedPoint rounded;
    // A point out of range was refused above.
    if (round_point(data_of(blob), point, infinity, rounded) != QueryStatus::ok) return nearest;
    const Winding winding = winding_around(data_of(blob), rounded);
    if (nearest.status == QueryStatus::not_found) nearest.distance = absolute(max_distance);
    if (winding.is_inside() && !winding.on_surface) nearest.distance = -nearest.distance;
    return nearest;
}

}  // namespace espalier
