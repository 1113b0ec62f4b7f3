// How far a query moves when it is rounded. The bounds are derived in docs/numerics.md.
#include <espalier/advanced/rounding.hpp>
#include <runtime/lattice/rounder.hpp>

namespace espalier {

using namespace detail;

namespace {

constexpr float half_ulp = 0x1p-24f;                // of a number, relative to it, at most
constexpr float square_root_of_3 = 0x1.bb67b2p+0f;  // rounded up, with room for the roundings of the bound itself

/// How far along an axis, in lattice steps, is how far at most, in local space.
Result<float> in_world(const Blob& blob, float along_axis) {
    if (blob.triangle_count() == 0) return {0.0f, QueryStatus::ok};
    return {scale_by_power_of_two(along_axis * square_root_of_3, data_of(blob).step_exponent), QueryStatus::ok};
}

/// The coordinates of a query in lattice steps, as floats before they are rounded to a grid.
struct Coordinates {
    Rounder rounder;
    float largest = 0.0f;  ///< of all, regardless of sign
    bool are_finite = true;

    template <std::same_as<Vec3>... Points>
    explicit Coordinates(const Blob& blob, const Points&... points) : rounder(data_of(blob)) {
        (add(points), ...);
    }
    void add(const Vec3& local) {
        float steps[3];
        are_finite = are_finite && is_finite(local);
        rounder.add_point(local, steps);
        for (const float at : steps) largest = maximum(absolute(at), largest);
    }
};

/// A point of the shape is a sum of `terms` vectors, each rounded to the grid; the first is a place.
Result<float> bound(const Blob& blob, const Coordinates& coordinates, int grid, unsigned terms = 1) {
    if (!coordinates.are_finite) return {0.0f, QueryStatus::invalid_argument};
    const float reach = coordinates.rounder.reach();
    if (!(reach < shape_reach)) return {0.0f, QueryStatus::out_of_range};
    const float half_grid = power_of_two(-fraction_bits_for(reach, grid) - 1);
    const auto count = whole_float(terms);
    return in_world(blob, count * half_grid + (coordinates.largest + count) * half_ulp);
}

Result<float> error_of(const Blob& blob, const Vec3& point) {
    return bound(blob, Coordinates(blob, point), point_grid);
}

Result<float> error_of(const Blob& blob, const Ray& ray) {
    const Coordinates origin(blob, ray.origin);
    const Vec3& way = ray.direction;
    const bool is_zero = (magnitude_bits(way.x) | magnitude_bits(way.y) | magnitude_bits(way.z)) == 0;
    if (!origin.are_finite || !is_finite(way) || is_zero) return {0.0f, QueryStatus::invalid_argument};
    if (!(origin.largest < 0x1p120f)) return {0.0f, QueryStatus::out_of_range};
    // The direction is off by as much at the far end of the asset as the origin by half an ulp there.
    const float reach = origin.rounder.reach();
    if (reach < 0x1p23f) {
        const float half_grid = power_of_two(-fraction_bits_for(reach, point_grid) - 1);
        return in_world(blob, half_grid + (origin.largest + reach + 1.0f) * half_ulp);
    }
    // The way to the asset takes five roundings more; its box is entered on a grid of whole steps at worst.
    float size = 0.0f;
    for (const float extent : data_of(blob).extent_steps) size = maximum(extent, size);
    return in_world(blob, 0.5f + 6.0f * (origin.largest + 2.0f * size + 1.0f) * half_ulp);
}

Result<float> error_of(const Blob& blob, const Segment& segment) {
    return bound(blob, Coordinates(blob, segment.from, segment.to), segment_grid);
}

Result<float> error_of(const Blob& blob, const Sphere& sphere) {
    if (!is_radius(sphere.radius)) return {0.0f, QueryStatus::invalid_argument};
    return error_of(blob, sphere.center);
}

Result<float> error_of(const Blob& blob, const Capsule& capsule) {
    if (!is_radius(capsule.radius)) return {0.0f, QueryStatus::invalid_argument};
    return error_of(blob, Segment{capsule.from, capsule.to});
}

Result<float> error_of(const Blob& blob, const Box& box) { return error_of(blob, Segment{box.min, box.max}); }

Result<float> error_of(const Blob& blob, const OrientedBox& box) {
    float spread = 0.0f;  // along any axis, of the half axes together
    // mutant(< -> <=) equivalent: z once more
    for (int k = 0; k < 3; ++k) {
        float along = 0.0f;
        for (const Vec3& half : box.half_axes) {
            if (!is_finite(half)) return {0.0f, QueryStatus::invalid_argument};
            // mutant(== -> != 2) equivalent: z and y change places, and the largest of the three is the same
            along += absolute(flush_subnormal(k == 0   ? half.x
                                              : k == 1 ? half.y
                                                       : half.z) *
                              data_of(blob).steps_per_unit);
        }
        spread = maximum(along, spread);
    }
    Coordinates center(blob, box.center);
    center.rounder.extend(center.rounder.reach() + spread);
    return bound(blob, center, volume_grid, 4);
}

Result<float> error_of(const Blob& blob, const Triangle& triangle) {
    return bound(blob, Coordinates(blob, triangle.a, triangle.b, triangle.c), volume_grid);
}

}  // namespace

Result<float> rounding_error(const Blob& blob, Vec3 point) noexcept {
    return blob ? error_of(blob, point) : Result<float>{};
}

template <RoundedShape Shape>
Result<float> rounding_error(const Blob& blob, const Shape& shape) noexcept {
    return blob ? error_of(blob, shape) : Result<float>{};
}
template Result<float> rounding_error(const Blob&, const Ray&) noexcept;
template Result<float> rounding_error(const Blob&, const Segment&) noexcept;
template Result<float> rounding_error(const Blob&, const Sphere&) noexcept;
template Result<float> rounding_error(const Blob&, const Capsule&) noexcept;
template Result<float> rounding_error(const Blob&, const Box&) noexcept;
template Result<float> rounding_error(const Blob&, const OrientedBox&) noexcept;
template Result<float> rounding_error(const Blob&, const Triangle&) noexcept;

}  // namespace espalier
