// Boxes of eight instances: one after the other, or a lane for each.
#ifndef ESPALIER_MOVING_SCENES_BOX_TREE_BOXES_IN_LANES_HPP
#define ESPALIER_MOVING_SCENES_BOX_TREE_BOXES_IN_LANES_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/moving_scenes/box_tree/ends_around.hpp>

ESPALIER_BEGIN_SET

#if ESPALIER_LANES == 1

ESPALIER_QUERY_OF_SET bool find_steps_boxes(const EightPlaces& places, std::int32_t step_exponent,
                                            EightStepsBoxes& boxes) {
    for (unsigned i = 0; i < EightStepsBoxes::count; ++i) {
        const Transform& transform = *places.transforms[i];
        StepsBox box;
        if (!is_in_range(transform.scale) || !find_steps_box(*places.parts[i], transform, step_exponent, box))
            return false;
        for (int k = 0; k < 3; ++k) {
            boxes.low[k][i] = box.low[k];
            boxes.negative_high[k][i] = -box.high[k];
        }
    }
    return true;
}

#elif ESPALIER_LANES == 16

using avx2::find_steps_boxes;

#else

namespace {

/// A number of each instance.
struct LaneNumbers {
    Floats values;

    ESPALIER_ALWAYS_INLINE friend LaneNumbers operator+(LaneNumbers a, LaneNumbers b) { return {a.values + b.values}; }
    ESPALIER_ALWAYS_INLINE friend LaneNumbers operator+(LaneNumbers a, float b) { return {a.values + splat(b)}; }
    ESPALIER_ALWAYS_INLINE friend LaneNumbers operator-(LaneNumbers a, LaneNumbers b) { return {a.values - b.values}; }
    ESPALIER_ALWAYS_INLINE friend LaneNumbers operator*(LaneNumbers a, LaneNumbers b) { return {a.values * b.values}; }
    ESPALIER_ALWAYS_INLINE friend LaneNumbers operator*(LaneNumbers a, float b) { return {a.values * splat(b)}; }
    ESPALIER_ALWAYS_INLINE friend LaneNumbers operator/(float a, LaneNumbers b) { return {splat(a) / b.values}; }
    ESPALIER_ALWAYS_INLINE friend LaneNumbers absolute(LaneNumbers a) { return {(magnitude)(a.values)}; }
    ESPALIER_ALWAYS_INLINE friend LaneNumbers without_below(LaneNumbers a, std::uint32_t least) {
        const auto bits = __builtin_bit_cast(SignedInts, a.values);
        const SignedInts is_below = (bits & 0x7FFFFFFF) < static_cast<std::int32_t>(least);
        return {__builtin_bit_cast(Floats, bits & ~is_below)};
    }
};

/// Three numbers of each instance, as Vec3 has them.
struct LaneVec3 {
    LaneNumbers x, y, z;
};

/// A vector of each instance, as Coordinates are one of a single instance.
class LaneCoordinates {
    LaneNumbers values_[3];

    template <class Compute>
    ESPALIER_ALWAYS_INLINE static LaneCoordinates of_each(Compute compute) {
        return {compute(0), compute(1), compute(2)};
    }

public:
    ESPALIER_ALWAYS_INLINE LaneCoordinates(LaneNumbers x, LaneNumbers y, LaneNumbers z) : values_{x, y, z} {}
    ESPALIER_ALWAYS_INLINE explicit LaneCoordinates(LaneNumbers all) : values_{all, all, all} {}
    ESPALIER_ALWAYS_INLINE explicit LaneCoordinates(float all) : LaneCoordinates(LaneNumbers{splat(all)}) {}
    ESPALIER_ALWAYS_INLINE explicit LaneCoordinates(const LaneVec3& v) : values_{v.x, v.y, v.z} {}

    using Self = LaneCoordinates;
    ESPALIER_ALWAYS_INLINE friend Self operator+(const Self& a, const Self& b) {
        return of_each([&](int k) { return a[k] + b[k]; });
    }
    ESPALIER_ALWAYS_INLINE friend Self operator-(const Self& a, const Self& b) {
        return of_each([&](int k) { return a[k] - b[k]; });
    }
    ESPALIER_ALWAYS_INLINE friend Self operator*(const Self& a, const Self& b) {
        return of_each([&](int k) { return a[k] * b[k]; });
    }
    ESPALIER_ALWAYS_INLINE friend Self without_tiny(const Self& a) {
        return of_each([&](int k) { return without_below(a[k], least_coordinate_bits); });
    }
    ESPALIER_ALWAYS_INLINE friend Self magnitude(const Self& a) {
        return of_each([&](int k) { return absolute(a[k]); });
    }
    ESPALIER_ALWAYS_INLINE friend bool are_at_least(const Self& a, const Self& b, float least) {
        SignedInts are = (a[0].values >= splat(least)) & (b[0].values >= splat(least));
        for (int k = 1; k < 3; ++k) are &= (a[k].values >= splat(least)) & (b[k].values >= splat(least));
        return bits_of(are) == (1u << lanes) - 1;
    }
    template <int x, int y, int z>
    ESPALIER_ALWAYS_INLINE static Self picked(const Self& a, const Self& b, const Self& c) {
        return {a[x], b[y], c[z]};
    }
    template <int x, int y, int z>
    [[nodiscard]] ESPALIER_ALWAYS_INLINE Self in_order() const {
        return {values_[x], values_[y], values_[z]};
    }
    /// Writes a row of eight for each coordinate.
    ESPALIER_ALWAYS_INLINE void store_whole_below(std::int32_t* to) const {
        for (int k = 0; k < 3; ++k) {
            const Floats all = values_[k].values;
            const auto whole = ESPALIER_CONVERT_VECTOR(all, SignedInts);
            const SignedInts is_above = (ESPALIER_CONVERT_VECTOR(whole, Floats) > all) |
                                        ((__builtin_bit_cast(SignedInts, all) < 0) & (whole == 0));
            const SignedInts below = whole + is_above;
            ESPALIER_COPY_BYTES(to + EightStepsBoxes::count * static_cast<unsigned>(k), &below, sizeof below);
        }
    }
    ESPALIER_ALWAYS_INLINE LaneNumbers operator[](int k) const { return values_[k]; }
};

struct LaneRotation {
    LaneNumbers x, y, z, w;
};
struct LaneTransform {
    LaneRotation rotation;
    LaneVec3 translation;
    LaneNumbers scale;
};
struct LanePart {
    LaneVec3 center, half;
    LaneNumbers coarsest_step, size;
};
struct LaneScaledRotation {
    LaneCoordinates axis;
    LaneNumbers w;
};

/// Returns the greatest of the numbers of a rotation, as the bits of a magnitude.
ESPALIER_ALWAYS_INLINE inline SignedInts greatest_bits(const LaneRotation& q) {
    const auto bits = [](LaneNumbers a) { return __builtin_bit_cast(SignedInts, a.values) & 0x7FFFFFFF; };
    return (larger)((larger)(bits(q.x), bits(q.y)), (larger)(bits(q.z), bits(q.w)));
}
/// Returns whether numbers are powers of two at least and at most.
ESPALIER_ALWAYS_INLINE inline bool are_between(SignedInts bits, int least_exponent, int most_exponent) {
    const auto least = static_cast<std::int32_t>(bits_of_power(least_exponent));
    const auto most = static_cast<std::int32_t>(bits_of_power(most_exponent));
    return bits_of((bits >= least) & (bits < most)) == (1u << lanes) - 1;
}
/// Returns what scaled_rotation() does, for quaternions whose largest part is between 2^-60 and 2^60.
ESPALIER_ALWAYS_INLINE inline LaneScaledRotation scaled_rotation(const LaneRotation& q) {
    const SignedInts power = greatest_bits(q) & static_cast<std::int32_t>(infinity_bits);
    const LaneNumbers factor = {__builtin_bit_cast(Floats, static_cast<std::int32_t>(2 * bits_of_power(0)) - power)};
    const auto scaled = [&](LaneNumbers a) { return without_below(a * factor, bits_of_power(-40)); };
    return {{scaled(q.x), scaled(q.y), scaled(q.z)}, scaled(q.w)};
}

/// Loads the first eight numbers of structures, one for each lane, and returns number k of all in numbers[k].
template <unsigned width, class Structure>
ESPALIER_ALWAYS_INLINE inline void load_eight(const Structure* const* from, LaneNumbers* numbers) {
    static_assert(sizeof(Structure) >= 8 * sizeof(float));
    if constexpr (width == 8) {
        Vector<float, width> row[8], pair[8];
        for (unsigned i = 0; i < 8; ++i) ESPALIER_COPY_BYTES(&row[i], from[i], sizeof row[i]);
        for (unsigned i = 0; i < 8; i += 2) {
            pair[i] = ESPALIER_SHUFFLE_VECTOR(row[i], row[i + 1], 0, 8, 1, 9, 4, 12, 5, 13);
            pair[i + 1] = ESPALIER_SHUFFLE_VECTOR(row[i], row[i + 1], 2, 10, 3, 11, 6, 14, 7, 15);
        }
        for (unsigned i = 0; i < 8; i += 4)
            for (unsigned k = 0; k < 2; ++k) {
                row[i + 2 * k] = ESPALIER_SHUFFLE_VECTOR(pair[i + k], pair[i + k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
                row[i + 2 * k + 1] = ESPALIER_SHUFFLE_VECTOR(pair[i + k], pair[i + k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
            }
        for (unsigned k = 0; k < 4; ++k) {
            numbers[k].values = ESPALIER_SHUFFLE_VECTOR(row[k], row[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
            numbers[k + 4].values = ESPALIER_SHUFFLE_VECTOR(row[k], row[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
        }
    } else {
        for (unsigned k = 0; k < 8; ++k) {
            float of_lanes[width];
            for (unsigned i = 0; i < width; ++i)
                ESPALIER_COPY_BYTES(&of_lanes[i], reinterpret_cast<const std::byte*>(from[i]) + k * sizeof(float),
                                    sizeof(float));
            ESPALIER_COPY_BYTES(&numbers[k].values, of_lanes, sizeof of_lanes);
        }
    }
}

}  // namespace

ESPALIER_QUERY_OF_SET bool find_steps_boxes(const EightPlaces& places, std::int32_t step_exponent,
                                            EightStepsBoxes& boxes) {
    for (unsigned first = 0; first < EightStepsBoxes::count; first += lanes) {
        LaneNumbers of_place[8], of_part[8];
        (load_eight<lanes>)(places.transforms + first, of_place);
        (load_eight<lanes>)(places.parts + first, of_part);
        const LaneTransform place = {
            {of_place[0], of_place[1], of_place[2], of_place[3]}, {of_place[4], of_place[5], of_place[6]}, of_place[7]};
        const LanePart part = {
            {of_part[0], of_part[1], of_part[2]}, {of_part[3], of_part[4], of_part[5]}, of_part[6], of_part[7]};
        if (!(are_between)((greatest_bits)(place.rotation), -60, 60) ||
            !(are_between)(__builtin_bit_cast(SignedInts, place.scale.values), -100, 100) ||
            !(to_steps)((ends_around<LaneCoordinates>)(part, place), step_exponent, &boxes.low[0][first],
                        &boxes.negative_high[0][first]))
            return false;
    }
    return true;
}

#endif

ESPALIER_END_SET

#endif
