// Inside or outside in the caller's units.
#include <espalier/inside.hpp>
#include <runtime/lattice_point.hpp>
#include <runtime/winding.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Why the blob or the point has no answer.
QueryStatus refusal(const Blob& blob, const Vec3& point) {
    if (!blob.closed()) return QueryStatus::not_closed;
    if (blob.copy_count() != 0) return QueryStatus::has_copies;
    return is_finite(point) ? QueryStatus::ok : QueryStatus::invalid_argument;
}

Winding winding_around(const BlobData& blob, const LatticePoint& point) {
    WindingRay ray;
    return shortest_way_out(blob, point, ray) ? winding_number(blob, ray) : Winding{};
}

}  // namespace

QueryStatus contains(const Blob& blob, Vec3 point, bool& inside) noexcept {
    if (const QueryStatus status = refusal(blob, point); status != QueryStatus::ok) return status;
    LatticePoint rounded;
    inside = round_point(blob.data(), point, infinity, rounded) && winding_around(blob.data(), rounded).is_inside();
    return QueryStatus::ok;
}

QueryStatus signed_distance(const Blob& blob, Vec3 point, float max_distance, Nearest& nearest) noexcept {
    if (const QueryStatus status = refusal(blob, point); status != QueryStatus::ok) return status;
    if (!is_radius(max_distance)) return QueryStatus::invalid_argument;
    LatticePoint rounded;
    if (!round_point(blob.data(), point, infinity, rounded)) return QueryStatus::out_of_range;
    const Winding winding = winding_around(blob.data(), rounded);
    if (!closest_point(blob, point, max_distance, nearest)) {
        nearest = {};
        nearest.triangle = no_triangle;
        nearest.distance = absolute(max_distance);
    }
    if (winding.is_inside() && !winding.on_surface) nearest.distance = -nearest.distance;
    return QueryStatus::ok;
}

}  // namespace espalier
