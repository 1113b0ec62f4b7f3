// Where the second blob's vertices land on the common grid: in integers, so that every machine places them alike.
#include <runtime/blob/duplicate_references.hpp>
#include <runtime/pairs/frame.hpp>
#include <runtime/transforms/rotation.hpp>

namespace espalier::detail {

namespace {

ESPALIER_SHARED_CODE int bit_length(std::int64_t a) {
    return 64 - std::countl_zero(static_cast<std::uint64_t>(magnitude(a)));
}

/// a * 2^shift, rounded to the nearest where that drops bits; the result must fit.
ESPALIER_SHARED_CODE std::int64_t shifted(std::int64_t a, int shift) {
    if (shift >= 0) return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) << shift);
    if (shift < -62) return 0;
    return ((a >> (-shift - 1)) + 1) >> 1;
}
ESPALIER_SHARED_CODE Int128 shifted_down(Argument<Int128> a, int shift) { return a >> shift; }
ESPALIER_SHARED_CODE Int128 shifted(Argument<Int128> a, int shift) {
    if (shift < -126) return Int128(0);
    if (shift < 0) return shifted_down(shifted_down(a, -shift - 1) + Int128(1), 1);
    return shift < 64 ? a << shift : (a << 63) << (shift - 63);
}

/// Numbers that come from far apart meet here: a's lattice steps with 40 bits of fraction.
constexpr int wide_fraction = 40;

/// False when it is beyond 2^80 steps: a mantissa below 2^55 times 2^exponent steps.
bool add_steps(Int128& sum, std::int64_t mantissa, int exponent) {
    if (mantissa == 0) return true;
    if (bit_length(mantissa) + exponent > 80) return false;
    sum = sum + shifted(Int128(mantissa), exponent + wide_fraction);
    return true;
}

/// The rotation's entries with 30 bits of fraction, each within 2^-30.
ESPALIER_SHARED_CODE void rotation_entries(const Quaternion& rotation, std::int64_t entries[3][3]) {
    const float components[4] = {rotation.x, rotation.y, rotation.z, rotation.w};
    int top = -1000;
    for (const float c : components) {
        const auto [mantissa, exponent] = parts_of(c);
        const int end = bit_length(mantissa) + exponent;
        if (mantissa != 0 && end > top) top = end;
    }
    std::int32_t q[4];  // the largest in [2^28, 2^29]
    for (int k = 0; k < 4; ++k) {
        const FloatParts parts = parts_of(components[k]);
        q[k] = static_cast<std::int32_t>(shifted(parts.mantissa, parts.exponent + 29 - top));
    }
    const auto product = [&](int i, int j) { return std::int64_t{q[i]} * q[j]; };
    const std::int64_t xx = product(0, 0), yy = product(1, 1), zz = product(2, 2), ww = product(3, 3);
    const std::int64_t n = xx + yy + zz + ww;  // 2^56 to 2^60
    std::int64_t numerators[3][3];
    for (int i = 0; i < 3; ++i) {
        const int j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
        numerators[i][i] = 2 * (ww + product(i, i)) - n;
        numerators[i][j] = 2 * (product(i, j) - product(3, k));
        numerators[j][i] = 2 * (product(i, j) + product(3, k));
    }
    const float inverse = 1.0f / to_float(n);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            // Twice a float quotient, the second of what the first left: the remainder is below 2 n, so that it may be
            // computed modulo 2^64.
            const auto numerator = static_cast<std::uint64_t>(numerators[i][j]);
            const float first = to_float(numerators[i][j]) * inverse * 0x1p22f;
            const auto high = to_integer(round_to_integer(first));
            const auto rest = static_cast<std::int64_t>((numerator << 22) - static_cast<std::uint64_t>(high) *
                                                                                static_cast<std::uint64_t>(n));
            const float second = to_float(rest) * inverse * 0x1p8f;
            entries[i][j] = high * 256 + to_integer(round_to_integer(second));
        }
}

/// What the culling tests need: each tree's view of the other. `scale` is b's step in steps of the grid.
ESPALIER_SHARED_CODE void derive_sides(PairFrame& frame, const std::int64_t rotation[3][3], float scale, float reach) {
    PairSide& in_a = frame.sides[0];
    PairSide& in_b = frame.sides[1];
    float offset[3];
    for (int k = 0; k < 3; ++k) offset[k] = to_float(frame.translation[k]) * power_of_two(-frame.fraction_bits);
    const float inverse = 1.0f / scale;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const float entry = to_float(rotation[i][j]) * 0x1p-30f;
            in_a.set(i, j, entry);
            in_b.set(j, i, entry);
        }
    for (int k = 0; k < 3; ++k) {
        in_a.offset[k] = offset[k];
        in_b.offset[k] = -(in_b.at(k, 0) * offset[0] + in_b.at(k, 1) * offset[1] + in_b.at(k, 2) * offset[2]) * inverse;
    }
    in_a.own_scale = frame.a_scale;
    in_a.scale = scale;
    in_a.common_size = 1.0f;
    in_b.own_scale = 1.0f;
    in_b.scale = frame.a_scale * inverse;
    in_b.common_size = scale;
    in_a.slack = 2.0f + reach * 0x1p-17f;
    // A b that is less than a step of the grid all over has no view of its own: nothing is culled in it.
    in_b.slack = scale < 0x1p-60f ? infinity : in_a.slack * inverse;
}

/// The bounds of an asset in its own space: the middle, and half of each side.
struct HalfBounds {
    float middle[3], half[3];
    float size = 0.0f;  ///< at least the sum of the absolute coordinates of any corner

    explicit HalfBounds(const BlobData& blob) {
        for (int k = 0; k < 3; ++k) {
            half[k] = scale_by_power_of_two(static_cast<float>(blob.extent[k]), blob.step_exponent - 1);
            middle[k] = blob.origin[k] + half[k];
            size += absolute(blob.origin[k]) + 2.0f * half[k];
        }
    }
};

}  // namespace

bool are_apart(const BlobData& a, const BlobData& b, const Transform& b_in_a, float distance) noexcept {
    const float scale = b_in_a.scale;
    if (!is_in_range(scale)) return false;
    const HalfBounds of_a(a), of_b(b);
    const PreparedTransform place(b_in_a);
    const auto product = [](float x, float y) { return without_tiny(x * y); };  // flush-to-zero changes no bit
    const auto scaled = [&](float x) { return product(scale, x); };
    const Vec3 middle = sum(place.rotated({scaled(of_b.middle[0]), scaled(of_b.middle[1]), scaled(of_b.middle[2])}),
                            place.translation());
    const float way[3] = {middle.x - of_a.middle[0], middle.y - of_a.middle[1], middle.z - of_a.middle[2]};
    float gap = 0.0f, span = 0.0f;
    float reach_in_a[3] = {of_a.half[0], of_a.half[1], of_a.half[2]};
    for (int j = 0; j < 3; ++j) {  // along the axes of b
        const Vec3 turned = place.rotated({j == 0 ? 1.0f : 0.0f, j == 1 ? 1.0f : 0.0f, j == 2 ? 1.0f : 0.0f});
        const float axis[3] = {turned.x, turned.y, turned.z}, half = scaled(of_b.half[j]);
        float along = 0.0f, reach = half;
        for (int k = 0; k < 3; ++k) {
            along += product(axis[k], way[k]);
            reach += product(absolute(axis[k]), of_a.half[k]);
            reach_in_a[k] += product(absolute(axis[k]), half);
        }
        gap = maximum(absolute(along) - reach, gap);
        span = maximum(maximum(of_a.half[j], half), span);
    }
    for (int k = 0; k < 3; ++k) gap = maximum(absolute(way[k]) - reach_in_a[k], gap);
    // Both are rounded to the grid, whose step is a part of a's or a share of the farthest coordinate.
    const Vec3 moved = place.translation();
    const float size = of_a.size + scaled(of_b.size) + sum_of_magnitudes(moved);
    const float steps = scale_by_power_of_two(size, -a.step_exponent);
    const float slack = size * 0x1p-16f + scale_by_power_of_two(1.0f, a.step_exponent - 5);
    if (!(size > 0x1p-72f && steps < 0x1p70f && gap > distance + slack)) return false;
    // Over many times the size of the blobs distances are refused, unless the gap clearly exceeds the greatest one that
    // is asked for.
    return gap < 512.0f * span || (gap > 8.0f * distance && span > 0.0f);
}

TrianglePair owners(const PairFrame& frame, const TrianglePair& pair) {
    return {{owner_of(*frame.a, pair.a.index)}, {owner_of(*frame.b, pair.b.index)}};
}

QueryStatus place_pair(const BlobData& a, const BlobData& b, const Transform& b_in_a, PairFrame& frame) noexcept {
    frame.a = &a;
    frame.b = &b;

    // The matrix: rotation times scale, 30 bits and a sign, in b's units per a's lattice step.
    std::int64_t rotation[3][3];
    rotation_entries(b_in_a.rotation, rotation);
    FloatParts scale = parts_of(b_in_a.scale);
    const int missing = 24 - bit_length(scale.mantissa);
    scale = {scale.mantissa << missing, scale.exponent - missing};
    std::int64_t matrix[3][3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) matrix[i][j] = shifted(rotation[i][j] * scale.mantissa, -24);
    const int unit_exponent = scale.exponent - 6 - a.step_exponent;  // of the matrix for b's units
    const int step_exponent = unit_exponent + b.step_exponent;       // and for b's lattice steps

    // Where b's lattice origin and the corners of its bounds are, in a's lattice.
    const float moved[3] = {b_in_a.translation.x, b_in_a.translation.y, b_in_a.translation.z};
    Int128 origin[3] = {};
    Int128 farthest(0);
    Int128 gap(0);
    Int128 span(0);
    const auto raise = [](Int128& most, Argument<Int128> to) {
        if (most < to) most = to;
    };
    for (int i = 0; i < 3; ++i) {
        const FloatParts move = parts_of(moved[i]);
        const FloatParts own = parts_of(a.origin[i]);
        if (!add_steps(origin[i], move.mantissa, move.exponent - a.step_exponent) ||
            !add_steps(origin[i], -own.mantissa, own.exponent - a.step_exponent))
            return QueryStatus::out_of_range;
        for (int j = 0; j < 3; ++j) {
            const FloatParts other = parts_of(b.origin[j]);
            if (!add_steps(origin[i], matrix[i][j] * other.mantissa, other.exponent + unit_exponent))
                return QueryStatus::out_of_range;
        }
        Int128 low = origin[i];
        Int128 high = origin[i];
        for (int j = 0; j < 3; ++j) {
            Int128& side = matrix[i][j] < 0 ? low : high;
            if (!add_steps(side, matrix[i][j] * b.extent[j], step_exponent)) return QueryStatus::out_of_range;
        }
        const Int128 own_side = Int128(a.extent[i]) << wide_fraction;
        raise(gap, low - own_side);
        raise(gap, -high);
        raise(span, high - low);
        raise(span, own_side);
        raise(farthest, magnitude(low));
        raise(farthest, magnitude(high));
        raise(farthest, own_side);
    }

    // The grid: coarse enough for both, no finer than either lattice has use for.
    const int needed = Unsigned256(farthest).bit_length() - wide_fraction - 24;
    const int other_step = scale.exponent + 23 + b.step_exponent - a.step_exponent;
    const int useful = (other_step < 0 ? other_step : 0) - 6;
    frame.shift = needed > useful ? needed : useful;
    frame.a_scale = power_of_two(-frame.shift);
    frame.a_round = frame.shift > 0 ? 0x1p23f : 0.0f;

    int fraction = frame.shift - step_exponent;
    constexpr int most_fraction = 36;
    const int dropped = fraction > most_fraction ? fraction - most_fraction : 0;
    const bool is_point = fraction < 0;  // then b's extent is 0: a larger one would be out of the grid
    fraction = is_point ? 0 : fraction - dropped;
    frame.fraction_bits = fraction;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            frame.matrix[i][j] = is_point ? 0 : static_cast<std::int32_t>(shifted(matrix[i][j], -dropped));
        const Int128 placed = shifted(origin[i], fraction - frame.shift - wide_fraction);
        frame.translation[i] =
            static_cast<std::int64_t>(placed.low) + (fraction > 0 ? std::int64_t{1} << (fraction - 1) : 0);
    }
    const float step = scale_by_power_of_two(to_float(scale.mantissa),
                                             scale.exponent + b.step_exponent - a.step_exponent - frame.shift);
    const auto on_grid = [&](Argument<Int128> length) {
        return to_float(shifted(length, -frame.shift - wide_fraction));
    };
    const float reach = on_grid(farthest) + 1.0f;
    frame.gap = on_grid(gap);
    frame.span = on_grid(span);
    derive_sides(frame, rotation, is_point || step < 0x1p-61f ? 0x1p-61f : step, reach);
    return QueryStatus::ok;
}

}  // namespace espalier::detail
