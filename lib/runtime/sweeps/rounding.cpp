// How far a sweep moves when it is rounded. The bound is derived in docs/numerics.md, Sweeps.
#include <cstddef>
#include <span>

#include <espalier/advanced/rounding.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/sweeps/round_sweep.hpp>

namespace espalier {

using namespace detail;

namespace {

constexpr float half_ulp = 0x1p-24f;                // of a number, relative to it, at most
constexpr float square_root_of_3 = 0x1.bb67b2p+0f;  // rounded up
constexpr float up = 1.0f + 0x1p-21f;               // more than the roundings of the bound itself

/// Returns the bound for a shape whose place is given by `points`. Each of its own points is a sum of `terms` vectors
/// that are rounded to the grid, the first of which is a place.
template <class Shape>
Result<float> bound(const Blob& blob, const Shape& shape, const Vec3& displacement, std::span<const Vec3> points,
                    unsigned terms = 1) {
    if (!blob) return {};
    const BlobData& data = data_of(blob);
    SweepOf<Shape> sweep;
    const QueryStatus status = round_sweep(data, shape, displacement, sweep);
    if (status != QueryStatus::ok || blob.triangle_count() == 0) return {0.0f, status};
    float largest = 0.0f;
    for (const Vec3& point : points) {
        const float at[3] = {point.x, point.y, point.z};
        for (int k = 0; k < 3; ++k) largest = maximum(absolute(to_steps(data, k, at[k])), largest);
    }
    // Half a unit of the grid for each vector, for the displacement and for the radius.
    const float half_grid = power_of_two(-sweep.fraction_bits - 1);
    const float count = whole_float(terms + 1);
    const float along_axis = count * half_grid + (largest + count) * half_ulp;
    const float steps = (along_axis * square_root_of_3 + (half_grid + half_ulp)) * up;
    return {scale_by_power_of_two(steps, data.step_exponent), QueryStatus::ok};
}

Result<float> error_of(const Blob& blob, const Sphere& sphere, Vec3 displacement) {
    return bound(blob, sphere, displacement, {&sphere.center, 1});
}
Result<float> error_of(const Blob& blob, const Capsule& capsule, Vec3 displacement) {
    const Vec3 ends[] = {capsule.from, capsule.to};
    return bound(blob, capsule, displacement, ends);
}
Result<float> error_of(const Blob& blob, const Box& box, Vec3 displacement) {
    const Vec3 ends[] = {box.min, box.max};
    return bound(blob, box, displacement, ends);
}
Result<float> error_of(const Blob& blob, const OrientedBox& box, Vec3 displacement) {
    return bound(blob, box, displacement, {&box.center, 1}, 4);
}
Result<float> error_of(const Blob& blob, const ConvexHull& hull, Vec3 displacement) {
    return bound(blob, hull, displacement, hull.vertices);
}

}  // namespace

template <SweptShape Shape>
Result<float> rounding_error(const Blob& blob, const Shape& shape, Vec3 displacement) noexcept {
    return error_of(blob, shape, displacement);
}
template Result<float> rounding_error(const Blob&, const Sphere&, Vec3) noexcept;
template Result<float> rounding_error(const Blob&, const Capsule&, Vec3) noexcept;
template Result<float> rounding_error(const Blob&, const Box&, Vec3) noexcept;
template Result<float> rounding_error(const Blob&, const OrientedBox&, Vec3) noexcept;
template Result<float> rounding_error(const Blob&, const ConvexHull&, Vec3) noexcept;

}  // namespace espalier
