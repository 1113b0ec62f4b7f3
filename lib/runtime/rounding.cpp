// How far a query moves when it is rounded. The bounds are derived in docs/numerics.md.
#include <espalier/rounding.hpp>
#include <runtime/float_bits.hpp>
#include <runtime/lattice_round.hpp>
#include <runtime/lattice_segment.hpp>

namespace espalier {

using namespace detail;

namespace {

constexpr float half_ulp = 0x1p-24f;                // of a number, relative to it, at most
constexpr float square_root_of_3 = 0x1.bb67b2p+0f;  // rounded up, with room for the roundings of the bound itself
constexpr int finest_grid = 6;                      // bits behind the point

/// How far along an axis, in lattice steps, is how far at most, in the world.
Result<float> in_world(const Blob& blob, float along_axis) {
    if (blob.triangle_count() == 0) return {0.0f, QueryStatus::ok};
    return {scale_by_power_of_two(along_axis * square_root_of_3, blob.data().step_exponent), QueryStatus::ok};
}

/// The coordinates of a query in lattice steps, as floats before they are rounded to a grid.
struct Coordinates {
    const BlobData& blob;
    float largest = 0.0f;  ///< of all, regardless of sign
    float reach = 0.0f;    ///< how far the asset is from the query at most, along any axis
    bool are_finite = true;

    void add(const Vec3& world, float spread = 0.0f) {
        const float coordinates[3] = {world.x, world.y, world.z};
        for (int k = 0; k < 3; ++k) {
            are_finite = are_finite && is_finite(coordinates[k]);
            const float at = to_steps(blob, k, coordinates[k]);
            const float high = blob.extent_steps[k] - at;
            largest = maximum(absolute(at), largest);
            reach = maximum(maximum(absolute(at), absolute(high)) + spread, reach);
        }
    }
    /// Bits of a grid on which whole numbers up to 2^bits hold all that is asked about.
    [[nodiscard]] int fraction_bits(int bits) const {
        const int spare = bits - exponent_of(reach);
        // mutant(> -> >=, < -> <=) equivalent: both sides are equal then
        return spare > finest_grid ? finest_grid : spare < 0 ? 0 : spare;
    }
};

/// A point of the shape is a sum of `terms` vectors, each rounded to the grid; the first is a place.
Result<float> bound(const Blob& blob, const Coordinates& coordinates, int bits, unsigned terms = 1) {
    if (!coordinates.are_finite) return {0.0f, QueryStatus::invalid_argument};
    if (!(coordinates.reach < segment_reach)) return {0.0f, QueryStatus::out_of_range};
    const float half_grid = power_of_two(-coordinates.fraction_bits(bits) - 1);
    const auto count = whole_float(terms);
    return in_world(blob, count * half_grid + (coordinates.largest + count) * half_ulp);
}

constexpr int point_grid = 23;
constexpr int segment_grid = 35;
constexpr int volume_grid = 22;

}  // namespace

Result<float> rounding_error(const Blob& blob, const Vec3& point) noexcept {
    Coordinates coordinates = {blob.data()};
    coordinates.add(point);
    return bound(blob, coordinates, point_grid);
}

Result<float> rounding_error(const Blob& blob, const Ray& ray) noexcept {
    Coordinates origin = {blob.data()};
    origin.add(ray.origin);
    const Vec3& way = ray.direction;
    const bool is_zero = (magnitude_bits(way.x) | magnitude_bits(way.y) | magnitude_bits(way.z)) == 0;
    if (!origin.are_finite || !is_finite(way) || is_zero) return {0.0f, QueryStatus::invalid_argument};
    if (!(origin.largest < 0x1p120f)) return {0.0f, QueryStatus::out_of_range};
    // The direction is off by as much at the far end of the asset as the origin by half an ulp there.
    if (origin.reach < 0x1p23f) {
        const float half_grid = power_of_two(-origin.fraction_bits(point_grid) - 1);
        return in_world(blob, half_grid + (origin.largest + origin.reach + 1.0f) * half_ulp);
    }
    // The way to the asset takes five roundings more; its box is entered on a grid of whole steps at worst.
    float size = 0.0f;
    for (const float extent : blob.data().extent_steps) size = maximum(extent, size);
    return in_world(blob, 0.5f + 6.0f * (origin.largest + 2.0f * size + 1.0f) * half_ulp);
}

Result<float> rounding_error(const Blob& blob, const Segment& segment) noexcept {
    Coordinates ends = {blob.data()};
    ends.add(segment.from);
    ends.add(segment.to);
    return bound(blob, ends, segment_grid);
}

Result<float> rounding_error(const Blob& blob, const Sphere& sphere) noexcept {
    if (!is_radius(sphere.radius)) return {0.0f, QueryStatus::invalid_argument};
    return rounding_error(blob, sphere.center);
}

Result<float> rounding_error(const Blob& blob, const Capsule& capsule) noexcept {
    if (!is_radius(capsule.radius)) return {0.0f, QueryStatus::invalid_argument};
    return rounding_error(blob, Segment{capsule.from, capsule.to});
}

Result<float> rounding_error(const Blob& blob, const Box& box) noexcept {
    return rounding_error(blob, Segment{box.min, box.max});
}

Result<float> rounding_error(const Blob& blob, const OrientedBox& box) noexcept {
    float spread = 0.0f;  // along any axis, of the half axes together
    // mutant(< -> <=) equivalent: z once more
    for (int k = 0; k < 3; ++k) {
        float along = 0.0f;
        for (const Vec3& half : box.half_axes) {
            if (!is_finite(half)) return {0.0f, QueryStatus::invalid_argument};
            // mutant(== -> != 2) equivalent: z and y change places, and the largest of the three is the same
            along += absolute(flush_subnormal(k == 0 ? half.x : k == 1 ? half.y : half.z) * blob.data().steps_per_unit);
        }
        spread = maximum(along, spread);
    }
    Coordinates center = {blob.data()};
    center.add(box.center, spread);
    return bound(blob, center, volume_grid, 4);
}

Result<float> rounding_error(const Blob& blob, const Corners& triangle) noexcept {
    Coordinates corners = {blob.data()};
    corners.add(triangle.a);
    corners.add(triangle.b);
    corners.add(triangle.c);
    return bound(blob, corners, volume_grid);
}

}  // namespace espalier
