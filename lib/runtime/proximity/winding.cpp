// Inside or outside by counting crossings: the kernel and the queries. The proof is in docs/numerics.md.
#include <espalier/distance.hpp>
#include <espalier/ray.hpp>
#include <runtime/kernels/point_triangle.hpp>
#include <runtime/lattice/round_point.hpp>
#include <runtime/traversal/volume.hpp>
#include <runtime/proximity/winding.hpp>

namespace espalier::detail {
namespace {

/// A corner seen from the point: across the ray and along it.
struct FromRay {
    std::int64_t y, z;
    std::int64_t along;
};

FromRay from_ray(const WindingRay& ray, const std::int32_t* corner) {
    const auto& [axis, up] = ray.direction;
    const auto from_origin = [&](int k) { return (std::int64_t{corner[k]} << ray.fraction_bits) - ray.origin[k]; };
    const std::int64_t along = from_origin(axis);
    return {from_origin((axis + 1) % 3), from_origin((axis + 2) % 3), up ? along : -along};
}

/// On which side of the line from a to b the ray passes, 1 or -1; 0 only when a and b are one point. A ray that meets
/// the line counts as moved by a little along z, and by far less against y.
int side_of(const FromRay& a, const FromRay& b, std::int64_t area) {
    const std::int64_t side = area != 0 ? area : a.y != b.y ? b.y - a.y : b.z - a.z;
    return side > 0 ? 1 : side < 0 ? -1 : 0;
}

/// What a triangle adds.
Winding winding_of(const WindingRay& ray, const LatticeTriangle& triangle) {
    bool is_around = true;
    for (int k = 0; k < 3 && is_around; ++k) {
        const auto [low, high] = span_of(triangle, k);
        is_around = (std::int64_t{low} << ray.fraction_bits) <= ray.origin[k] &&
                    (std::int64_t{high} << ray.fraction_bits) >= ray.origin[k];
    }
    if (is_around && distance_to(relative_to(ray, triangle), ray.fraction_bits).numerator.is_zero()) return {0, true};
    return {crossing(ray, triangle), false};
}

/// The way from the point out of the asset, as a volume: it overlaps the triangles that add something.
struct WayOut : Volume {
    const WindingRay& ray;

    explicit WayOut(const WindingRay& along)
        : Volume([](const Volume& way, const LatticeTriangle& triangle) {
              const Winding winding = winding_of(static_cast<const WayOut&>(way).ray, triangle);
              return winding.on_surface || winding.number != 0;
          }),
          ray(along) {
        for (int k = 0; k < 3; ++k) {  // what holds a point between two lattice planes reaches to both
            bounds.low[k] = static_cast<std::int32_t>(-(-ray.origin[k] >> ray.fraction_bits));
            bounds.high[k] = static_cast<std::int32_t>(ray.origin[k] >> ray.fraction_bits);
        }
        const int axis = ray.direction.axis;
        if (ray.direction.up) bounds.high[axis] = bounds_limit;
        else bounds.low[axis] = -bounds_limit;
    }
};

// Volumes hand over triangles with their corners: it is never called.
constexpr auto none = [](TriangleId) { return Visit::next; };
constexpr TriangleVisitor visits_none(none);

/// What the crossings of all triangles add up to; a point on one of them ends it.
struct SumOfCrossings : Each {
    const WindingRay& ray;
    Winding sum;

    SumOfCrossings(const BlobData& of, const WindingRay& along) : Each(of, visits_none), ray(along) {
        on_triangle = [](Each& self, std::uint32_t, const LatticeTriangle& triangle) {
            auto& own = static_cast<SumOfCrossings&>(self);
            const Winding winding = winding_of(own.ray, triangle);
            own.sum.number += winding.number;
            own.sum.on_surface = winding.on_surface;
            return winding.on_surface ? Visit::stop : Visit::next;
        };
    }
};

}  // namespace

std::int32_t crossing(const WindingRay& ray, const LatticeTriangle& triangle) noexcept {
    const FromRay a = from_ray(ray, triangle.corner[0]);
    const FromRay b = from_ray(ray, triangle.corner[1]);
    const FromRay c = from_ray(ray, triangle.corner[2]);
    const auto area = [](const FromRay& p, const FromRay& q) { return p.y * q.z - p.z * q.y; };
    const std::int64_t weight_a = area(b, c), weight_b = area(c, a), weight_c = area(a, b);
    const int side = side_of(b, c, weight_a);
    if (side == 0 || side_of(c, a, weight_b) != side || side_of(a, b, weight_c) != side) return 0;
    // Where the line meets the triangle, from the point on: the mean of the corners by these weights.
    Int128 along = multiply(a.along, weight_a) + multiply(b.along, weight_b) + multiply(c.along, weight_c);
    if (side < 0) along = -along;
    if (along.is_negative()) return 0;
    return ray.direction.up ? side : -side;
}

bool shortest_way_out(const BlobData& blob, const RoundedPoint& point, WindingRay& ray) noexcept {
    if (point.distance_offset != 0.0f) return false;
    std::int64_t shortest = INT64_MAX;
    for (int k = 0; k < 3; ++k) {
        const std::int64_t down = point.origin[k];
        const std::int64_t up = (std::int64_t{blob.extent[k]} << point.fraction_bits) - down;
        if (down < 0 || up < 0) return false;
        if (down < shortest) ray.direction = {k, false};
        shortest = down < shortest ? down : shortest;
        if (up < shortest) ray.direction = {k, true};
        shortest = up < shortest ? up : shortest;
        ray.origin[k] = point.origin[k];
    }
    ray.fraction_bits = point.fraction_bits;
    return true;
}

Winding winding_number(const BlobData& blob, const WindingRay& ray) noexcept {
    const WayOut way(ray);
    SumOfCrossings crossings(blob, ray);
    find_overlaps_of_volume(blob, way, crossings, exactly);
    return crossings.sum;
}

Winding winding_around(const BlobData& blob, const Vec3& point) noexcept {
    RoundedPoint rounded;
    WindingRay ray;
    if (round_point(blob, point, infinity, rounded) != QueryStatus::ok || !shortest_way_out(blob, rounded, ray))
        return {};
    return winding_number(blob, ray);
}

}  // namespace espalier::detail

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

/// The points of a Fibonacci lattice on the upper half of the unit sphere, one after the other.
class HalfSphere {
public:
    explicit HalfSphere(unsigned count) : step_(1.0f / static_cast<float>(count)) {}

    /// Returns the next direction, of about unit length.
    Vec3 next() {
        const float z = (static_cast<float>(number_) + 0.5f) * step_;
        const float radius = square_root((1.0f - z) * (1.0f + z));
        const Vec3 direction = {radius * cosine_, radius * sine_, z};
        // Turns by the golden angle, pi * (3 - sqrt(5)).
        constexpr float cosine = -0.737368878f, sine = 0.675490294f;
        const float turned = cosine_ * cosine - sine_ * sine;
        sine_ = cosine_ * sine + sine_ * cosine;
        cosine_ = turned;
        ++number_;
        return direction;
    }

private:
    float step_;
    unsigned number_ = 0;
    float cosine_ = 1.0f;
    float sine_ = 0.0f;
};

/// Adds what a ray counts: 1 where it leaves the surface's inside, -1 where it enters.
QueryStatus add_crossings(const Blob& blob, const Ray& ray, std::int64_t& sum) {
    return for_each_crossing(blob, ray, [&sum](const RayHit& hit) { sum += hit.side == Side::back ? 1 : -1; });
}

}  // namespace

YesNo contains(const Blob& blob, Vec3 point) noexcept {
    if (const QueryStatus status = refusal(blob, point); status != QueryStatus::ok) return YesNo(status);
    return YesNo::of(winding_around(data_of(blob), point).is_inside());
}

ClosestPoint signed_distance(const Blob& blob, Vec3 point, float max_distance) noexcept {
    const QueryStatus status = refusal(blob, point);
    // Built where the caller keeps it: a second one would be on the stack during the walk.
    ClosestPoint nearest = status == QueryStatus::ok ? closest_point(blob, point, max_distance) : nothing_near(status);
    if (is_refused(nearest.status)) return nearest;
    const Winding winding = winding_around(data_of(blob), point);
    if (nearest.status == QueryStatus::not_found) nearest.distance = absolute(max_distance);
    if (winding.is_inside() && !winding.on_surface) nearest.distance = -nearest.distance;
    return nearest;
}

Result<float> winding_number(const Blob& blob, Vec3 point, unsigned directions) noexcept {
    Result<float> winding;
    winding.status = blob ? QueryStatus::invalid_argument : QueryStatus::not_open;
    if (!blob || directions < 2 || directions > max_winding_directions) return winding;
    const unsigned pairs = (directions + 1) / 2;
    HalfSphere lattice(pairs);
    std::int64_t sum = 0;
    for (unsigned i = 0; i < pairs; ++i) {
        const Vec3 up = lattice.next();
        for (const Vec3& way : {up, Vec3{-up.x, -up.y, -up.z}}) {
            winding.status = add_crossings(blob, {.origin = point, .direction = way}, sum);
            if (winding.status != QueryStatus::ok) return winding;
        }
    }
    winding.value = static_cast<float>(sum) / static_cast<float>(2 * pairs);
    return winding;
}

}  // namespace espalier
