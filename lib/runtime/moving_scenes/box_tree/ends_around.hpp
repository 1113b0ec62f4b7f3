// The box around a part at its place: one formula, for a place alone and for several places in lanes.
#ifndef ESPALIER_MOVING_SCENES_BOX_TREE_ENDS_AROUND_HPP
#define ESPALIER_MOVING_SCENES_BOX_TREE_ENDS_AROUND_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/moving_scenes/box_tree/steps_box.hpp>
#include <runtime/transforms/rotation.hpp>

ESPALIER_BEGIN_SET

#if ESPALIER_SMALL_CODE
inline ScaledRotation scaled_rotation(const Quaternion& rotation) {
    const Quaternion q = with_greatest_of_one(rotation);
    return {{q.x, q.y, q.z}, q.w};
}
inline Coordinates without_tiny(const Coordinates& v) { return without_below(v, least_coordinate_bits); }
#endif

/// The two ends of a box in float.
template <class Vector>
struct BoxEnds {
    Vector low, high;
};

/// Returns the box around a part at its place. Its rotation is computed with one division and is off by some 2^-22,
/// which the margin covers; like that of PreparedTransform it is the same where subnormal numbers are flushed. Part
/// and Place have the members of PartBounds and Transform.
template <class Vector, class Part, class Place>
ESPALIER_SHARED_OR_PART_OF_CALLER inline BoxEnds<Vector> ends_around(const Part& part, const Place& place) {
    const auto rotation = scaled_rotation(place.rotation);
    const Vector q = rotation.axis, w(rotation.w), scale(place.scale);
    const Vector squares = q * q;
    const auto ww = rotation.w * rotation.w;
    const Vector twice(2.0f / ((squares[0] + squares[1]) + (squares[2] + ww)));
    // Entries 00 11 22, 01 12 20 and 10 21 02 of the rotation's matrix.
    const Vector diagonal =
        Vector(1.0f) - (squares.template in_order<1, 2, 0>() + squares.template in_order<2, 0, 1>()) * twice;
    const Vector symmetric = q * q.template in_order<1, 2, 0>(), skew = w * q.template in_order<2, 0, 1>();
    const Vector above = (symmetric - skew) * twice, below = (symmetric + skew) * twice;
    const Vector entries[3] = {Vector::template picked<0, 0, 2>(diagonal, below, above),
                               Vector::template picked<0, 1, 1>(above, diagonal, below),
                               Vector::template picked<2, 1, 2>(below, above, diagonal)};
    const Vector center = without_tiny(Vector(part.center) * scale);
    const Vector half_local = without_tiny(Vector(part.half) * scale);
    const auto combined = [](const Vector& x, const Vector& y, const Vector& z, const Vector& v) {
        return (without_tiny(x * v.template in_order<0, 0, 0>()) + without_tiny(y * v.template in_order<1, 1, 1>())) +
               without_tiny(z * v.template in_order<2, 2, 2>());
    };
    const Vector from = combined(entries[0], entries[1], entries[2], center);
    const Vector half = combined(magnitude(entries[0]), magnitude(entries[1]), magnitude(entries[2]), half_local);
    const Vector by = without_tiny(Vector(place.translation));
    const auto own_margin = part.size * 0x1p-16f + (part.coarsest_step * 0x1p-6f + 0x1p-97f);
    const Vector margin(place.scale * own_margin + 0x1p-96f);
    const Vector reach = half + (margin + (magnitude(by) + magnitude(from)) * Vector(0x1p-21f));
    return {(from + by) - reach, (from + by) + reach};
}

/// Writes a box in whole steps, rounded outward, the upper end with the other sign. Returns false, and writes nothing,
/// if it leaves the world or is NaN.
template <class Vector>
ESPALIER_ALWAYS_INLINE inline bool to_steps(const BoxEnds<Vector>& ends, std::int32_t step_exponent, std::int32_t* low,
                                            std::int32_t* negative_high) {
    const Vector per_unit(power_of_two(-step_exponent));
    const Vector lower = ends.low * per_unit, above = ends.high * per_unit;
    const Vector upper = Vector(-1.0f) * above;
    constexpr auto most = static_cast<float>(most_world_steps);
    if (!are_at_least(lower, upper, -most)) return false;
    lower.store_whole_below(low);
    upper.store_whole_below(negative_high);
    return true;
}

ESPALIER_END_SET

#endif
