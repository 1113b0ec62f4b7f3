#include <runtime/moving_scenes/box_tree/steps_box.hpp>

#include <runtime/transforms/rotation.hpp>

namespace espalier::detail {

namespace {

/// Returns at least how far a point of the part is from its local origin along any axis.
float size_of(const PartBounds& bounds) {
    const Vec3 &c = bounds.center, &h = bounds.half;
    return ((absolute(c.x) + h.x) + (absolute(c.y) + h.y)) + (absolute(c.z) + h.z);
}

/// The two ends of a box in float.
struct BoxEnds {
    Coordinates low, high;
};

#if ESPALIER_SMALL_CODE
struct ScaledRotation {
    Coordinates axis;
    float w;
};
ScaledRotation scaled_rotation(const Quaternion& rotation) {
    const Quaternion q = with_greatest_of_one(rotation);
    return {{q.x, q.y, q.z}, q.w};
}
Coordinates without_tiny(const Coordinates& v) { return without_below(v, least_coordinate_bits); }
#endif

/// Returns the box around a part at its place. Its rotation is computed with one division and is off by some 2^-22,
/// which the margin covers; like that of PreparedTransform it is the same where subnormal numbers are flushed.
ESPALIER_SHARED_OR_PART_OF_CALLER inline BoxEnds ends_around(const PartBounds& bounds, const Transform& transform) {
    const ScaledRotation rotation = scaled_rotation(transform.rotation);
    const Coordinates q = rotation.axis, w(rotation.w), scale(transform.scale);
    const Coordinates squares = q * q;
    const float ww = rotation.w * rotation.w;
    const Coordinates twice(2.0f / ((squares[0] + squares[1]) + (squares[2] + ww)));
    // Entries 00 11 22, 01 12 20 and 10 21 02 of the rotation's matrix.
    const Coordinates diagonal =
        Coordinates(1.0f) - (squares.in_order<1, 2, 0>() + squares.in_order<2, 0, 1>()) * twice;
    const Coordinates symmetric = q * q.in_order<1, 2, 0>(), skew = w * q.in_order<2, 0, 1>();
    const Coordinates above = (symmetric - skew) * twice, below = (symmetric + skew) * twice;
    const Coordinates columns[3] = {Coordinates::picked<0, 0, 2>(diagonal, below, above),
                                    Coordinates::picked<0, 1, 1>(above, diagonal, below),
                                    Coordinates::picked<2, 1, 2>(below, above, diagonal)};
    const Coordinates center = without_tiny(Coordinates(bounds.center) * scale);
    const Coordinates half_local = without_tiny(Coordinates(bounds.half) * scale);
    const auto combined = [](const Coordinates& x, const Coordinates& y, const Coordinates& z, const Coordinates& v) {
        return (without_tiny(x * v.in_order<0, 0, 0>()) + without_tiny(y * v.in_order<1, 1, 1>())) +
               without_tiny(z * v.in_order<2, 2, 2>());
    };
    const Coordinates from = combined(columns[0], columns[1], columns[2], center);
    const Coordinates half = combined(magnitude(columns[0]), magnitude(columns[1]), magnitude(columns[2]), half_local);
    const Coordinates by = without_tiny(Coordinates(transform.translation));
    const float own_margin = size_of(bounds) * 0x1p-16f + (bounds.coarsest_step * 0x1p-6f + 0x1p-97f);
    const Coordinates margin(transform.scale * own_margin + 0x1p-96f);
    const Coordinates reach = half + (margin + (magnitude(by) + magnitude(from)) * Coordinates(0x1p-21f));
    return {(from + by) - reach, (from + by) + reach};
}

}  // namespace

PartBounds bounds_of(const BlobData& mesh) {
    const float step = power_of_two(mesh.step_exponent);
    PartBounds bounds = {{}, {}, step, 1.0f};
    float* const center[3] = {&bounds.center.x, &bounds.center.y, &bounds.center.z};
    float* const half[3] = {&bounds.half.x, &bounds.half.y, &bounds.half.z};
    for (int k = 0; k < 3; ++k) {
        *half[k] = 0.5f * (mesh.extent_steps[k] * step);
        *center[k] = mesh.origin[k] + *half[k];
    }
    return bounds;
}

PartBounds bounds_of(const BakedScene& tile) {
    const SceneData& data = data_of(tile);
    PartBounds bounds = bounds_of(data.tree);
    bounds.coarsest_step = data.coarsest_step;
    bounds.largest_scale = maximum(data.largest_scale, 1.0f);
    return bounds;
}

void Coarseness::add(const PartBounds& bounds, const Transform& transform) {
    coarsest_step = maximum(detail::without_tiny(transform.scale * bounds.coarsest_step), coarsest_step);
    largest_scale = maximum(detail::without_tiny(transform.scale * bounds.largest_scale), largest_scale);
    farthest_origin = maximum(detail::without_tiny(transform.scale * size_of(bounds)), farthest_origin);
}

Box box_around(const PartBounds& bounds, const Transform& transform) {
    const BoxEnds ends = ends_around(bounds, transform);
    return {ends.low.vector(), ends.high.vector()};
}

bool find_steps_box(const PartBounds& bounds, const Transform& transform, std::int32_t step_exponent, StepsBox& box) {
    const BoxEnds ends = ends_around(bounds, transform);
    const Coordinates to_steps(power_of_two(-step_exponent));
    const Coordinates low = ends.low * to_steps, above = ends.high * to_steps;
    const Coordinates high = Coordinates(-1.0f) * above;
    constexpr auto most = static_cast<float>(most_world_steps);
    if (!are_at_least(low, high, -most)) return false;
    low.store_whole_below(box.low);
    high.store_whole_below(box.high);
    for (std::int32_t& steps : box.high) steps = -steps;
    return true;
}

}  // namespace espalier::detail
