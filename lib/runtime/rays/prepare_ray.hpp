// Prepares a ray for the slab tests and leaves of a set. In lanes: all axes at once in the ordinary case, with the bits
// of the definition in lattice/round_ray.hpp; relies on round-to-nearest, as that does.
#ifndef ESPALIER_RAYS_PREPARE_RAY_HPP
#define ESPALIER_RAYS_PREPARE_RAY_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/rays/queries.hpp>

ESPALIER_BEGIN_SET

#if ESPALIER_LANES == 1

/// Prepares a Ray or a RayOnLattice. Returns ok, or why there is nothing to walk.
template <class Caller, class Lanes>
ESPALIER_ALWAYS_INLINE inline QueryStatus prepare(const BlobData& blob, const Caller& ray,
                                                  PreparedRayIn<Lanes>& prepared) {
    return blob.triangle_count != 0 && prepare_ray(blob, ray, prepared) ? QueryStatus::ok
                                                                        : status_without_walk(blob, ray);
}

#elif ESPALIER_LANES == 16

using avx2::prepare;  // packed nodes have eight children

#else

/// Stores the inverse direction for the slab test. Returns tau of coordinate 0, counted from lattice point 0 0 0.
inline Axes set_inverse(const BlobData& blob, Axes of_step, RayLanes& ray_lanes) {
    store_axes(ray_lanes.inverse, of_step);
    store_axes(ray_lanes.base_inverse, of_step * blob.base_unit);
    return Axes{};
}

/// What spread_ray writes, of all axes at once. Returns what set_inverse does.
template <class Lanes>
inline Axes spread_in_lanes(const BlobData& blob, Axes minus_origin, Axes inverse, float slack_steps, unsigned signs,
                            Lanes& ray_lanes) {
    const Axes low = set_inverse(blob, inverse, ray_lanes);
    const Axes middle = minus_origin * inverse - low;
    const float whole_slack = slack_steps + Lanes::box_slack(blob);
    const Axes slack = __builtin_bit_cast(Axes, __builtin_bit_cast(AxisInts, inverse) & 0x7FFFFFFF) * whole_slack;
    store_axes(ray_lanes.near_offset, middle - slack);
    store_axes(ray_lanes.far_offset, middle + slack);
    ray_lanes.tau_min = 0.0f;
    ray_lanes.planes = Lanes::plane_orders()[signs];
    return low;
}

/// Not of an ordinary ray: an argument out of the domain, a subnormal direction, an origin from far away.
inline constexpr QueryStatus not_ordinary = QueryStatus::invalid_argument;

/// Rounds an ordinary ray, fills its lanes, and tests it against the asset's box, all in one: what round_ray,
/// spread_ray and meets_asset do one after the other. What only leaves need comes last, since many rays miss the box.
template <class Lanes>
ESPALIER_ALWAYS_INLINE inline QueryStatus prepare_ordinary(const BlobData& blob, const Ray& ray, LatticeRay& rounded,
                                                           Lanes& ray_lanes) {
    // For each axis: what follows is of no meaning. GCC loads such a constant, where it would build one of equal
    // elements.
    const auto each = [](std::int32_t x) ESPALIER_ALWAYS_INLINE_LAMBDA { return AxisInts{x, x, x, 0}; };
    const AxisInts magnitudes = each(0x7FFFFFFF), xyz = each(-1);
    // What follows in the structure is masked off.
    const auto three = [](const float* at) ESPALIER_ALWAYS_INLINE_LAMBDA { return load_as<AxisInts>(at); };
    const auto floats = [](AxisInts bits) ESPALIER_ALWAYS_INLINE_LAMBDA { return __builtin_bit_cast(Axes, bits); };
    const auto bits = [](Axes numbers) ESPALIER_ALWAYS_INLINE_LAMBDA { return __builtin_bit_cast(AxisInts, numbers); };
    const auto largest_of = [](AxisInts a) ESPALIER_ALWAYS_INLINE_LAMBDA {  // in every element
        const AxisInts two = larger(a, ESPALIER_SHUFFLE_VECTOR(a, a, 2, 3, 0, 1));
        return larger(two, ESPALIER_SHUFFLE_VECTOR(two, two, 1, 0, 3, 2));
    };
    // 2^(23 - e) for numbers in [2^e, 2^(e+1)): integers of 24 bits are left. The sum needs all 32 bits.
    const auto to_24_bits = [](AxisInts numbers) ESPALIER_ALWAYS_INLINE_LAMBDA {
        using Words = Vector<std::uint32_t, 4>;
        constexpr std::uint32_t sum = (23u + 2u * 127u) << 23, exponent = 0x7F800000u;
        const Words exponents = __builtin_bit_cast(Words, numbers) & Words{exponent, exponent, exponent, 0};
        return __builtin_bit_cast(AxisInts, Words{sum, sum, sum, 0} - exponents);
    };

    const AxisInts direction = three(&ray.direction.x);
    const AxisInts lengths = direction & magnitudes;
    const AxisInts longest = largest_of(lengths);
    AxisInts integers = round_to_integers(floats(direction) * floats(to_24_bits(longest))) & xyz;
    const AxisInts at_rest = (integers == 0) & std::bit_cast<std::int32_t>(1.0f / still);  // see or_if_zero
    const Axes inverse = 1.0f / floats(bits(ESPALIER_CONVERT_VECTOR(integers, Axes)) | at_rest);

    const AxisInts eye = three(&ray.origin.x);
    const AxisInts normal = eye & ((eye & magnitudes) > each(0x007FFFFF));
    const Axes origin = (floats(normal) - load_as<Axes>(blob.origin)) * blob.steps_per_unit;
    const Axes to_high = load_as<Axes>(blob.extent_steps) - origin;
    const AxisInts reach = largest_of(larger(bits(origin) & magnitudes, bits(to_high) & magnitudes));
    const AxisInts fraction_scale = smaller(to_24_bits(reach), each((6 + 127) << 23));
    AxisInts fine = round_to_integers(origin * floats(fraction_scale));

    const int exponent = (longest[0] >> 23) - 127;
    const int fraction_bits = (fraction_scale[0] >> 23) - 127;
    const auto t_min = std::bit_cast<std::uint32_t>(ray.t_min);
    const auto t_max = std::bit_cast<std::uint32_t>(ray.t_max);
    if (exponent < -100 || exponent > 127 || fraction_bits <= 0 || t_min != 0 || t_max > infinity_bits)
        return not_ordinary;

    // A finite t_max is scaled in its exponent, while that stays in the middle of its range.
    const int t_exponent = blob.step_exponent - exponent + 23;
    rounded.tau_min = 0.0f;
    rounded.tau_max = ray.t_max;
    if (t_max != infinity_bits) {
        const int biased = static_cast<int>(t_max >> 23) - t_exponent;
        if (t_max < 0x00800000u || biased < 64 || biased > 250) return not_ordinary;
        rounded.tau_max = std::bit_cast<float>((static_cast<std::uint32_t>(biased) << 23) | (t_max & 0x007FFFFFu));
    }

    const float reach_steps = floats(reach)[0];
    const Axes one_unit = floats(each(2 * 127 << 23) - fraction_scale);
    const Axes minus_origin = -(ESPALIER_CONVERT_VECTOR(fine, Axes) * one_unit);
    const Axes low =
        spread_in_lanes(blob, minus_origin, inverse, slab_slack(reach_steps), bits_of(integers < 0), ray_lanes);
    const Axes high = load_as<Axes>(blob.extent_steps) * inverse + low;
    const Axes enter = smaller(low, high) + load_as<Axes>(ray_lanes.near_offset);
    const Axes leave = larger(low, high) + load_as<Axes>(ray_lanes.far_offset);
    const float last_in = maximum(maximum(enter[0], enter[1]), enter[2]);
    const float first_out = minimum(minimum(leave[0], leave[1]), leave[2]);
    if (!(last_in <= first_out && first_out >= 0.0f)) return QueryStatus::not_found;

    store_axes(rounded.zero, minus_origin);
    rounded.tau_offset = 0.0f;
    // Each fills its register together with the number behind it.
    integers[3] = t_exponent;
    fine[3] = fraction_bits;
    store_axes(rounded.direction, integers);
    store_axes(rounded.origin, fine);
    // Where rounding makes two components equally long this may choose the other one, which only changes the filter.
    const auto axis = static_cast<unsigned>(std::countr_zero(bits_of(lengths == longest)));
    set_longest_axis(rounded, axis);
    alignas(16) float steps[4];
    store_axes(steps, inverse);
    set_shear(rounded, steps[axis], reach_steps);
    rounded.culling = ray.culling;
    return QueryStatus::ok;
}

/// Prepares a Ray or a RayOnLattice. Returns ok, or why there is nothing to walk.
template <class Caller, class Lanes>
ESPALIER_NOINLINE QueryStatus prepare(const BlobData& blob, const Caller& ray, PreparedRayIn<Lanes>& prepared) {
    if (blob.triangle_count == 0) return status_without_walk(blob, ray);
    if constexpr (std::is_same_v<Caller, Ray>) {
        const QueryStatus status = prepare_ordinary(blob, ray, prepared.ray, prepared.in_lanes);
        if (status != not_ordinary) return status;
    }
    return prepare_ray(blob, ray, prepared) ? QueryStatus::ok : status_without_walk(blob, ray);
}

#endif

ESPALIER_END_SET

#endif
