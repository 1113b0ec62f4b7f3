// Planes moved into lattice units in integers: with floats the offset of an asset far from its local origin would
// lose most of its digits.
#include <runtime/base/wide_integer.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/overlap/bounding_plane.hpp>
#include <runtime/overlap/rounded_shapes.hpp>

namespace espalier::detail {

namespace {

/// Offsets are added up in units of 2^-16, so that cutting off what is below moves none of them noticeably.
constexpr int guard_bits = 16;
constexpr int longest_term = 120;

/// mantissa * 2^exponent in those units; where that is too long, as long as a term can be.
bool to_fixed_point(FloatParts parts, Int128& term) {
    const int shift = parts.exponent + guard_bits;
    const int length = 64 - std::countl_zero(static_cast<std::uint64_t>(magnitude(parts.mantissa)));
    if (parts.mantissa == 0 || shift < -63) return term = Int128(), true;
    if (shift <= 0) return term = Int128(parts.mantissa >> -shift), true;
    if (length + shift > longest_term) {
        const Int128 most = Int128(std::int64_t{1} << (longest_term - 64), 0);
        return term = negate_if(most, parts.mantissa < 0), false;
    }
    term = shift < 64 ? Int128(parts.mantissa) << shift : (Int128(parts.mantissa) << 63) << (shift - 63);
    return true;
}

/// With an offset beyond this, all boxes of a node lie on the same side of the plane.
constexpr std::int64_t farthest_offset = std::int64_t{1} << 52;

/// dot(n, origin + step * x) <= offset, divided by step and scaled by the power of two that makes n's largest
/// coordinate an integer of 24 bits. Only then are n's coordinates rounded: that turns the plane about lattice point 0.
bool round_half_space(const BlobData& blob, const FloatParts* normal, float world_offset, LatticePlane& plane) {
    int longest = -1000;
    for (int k = 0; k < 3; ++k)
        if (normal[k].mantissa != 0 && normal[k].exponent > longest) longest = normal[k].exponent;
    for (int k = 0; k < 3; ++k) {
        const int shift = longest - normal[k].exponent;
        const std::int64_t length = magnitude(normal[k].mantissa);
        const std::int64_t rounded = shift == 0   ? length
                                     : shift > 24 ? 0
                                                  : (length + (std::int64_t{1} << (shift - 1))) >> shift;
        plane.normal[k] = static_cast<std::int32_t>(negate_if(rounded, normal[k].mantissa < 0));
    }
    const int to_steps = -longest - blob.step_exponent;
    Int128 offset;
    FloatParts parts = parts_of(flush_subnormal(world_offset));
    parts.exponent += to_steps;
    to_fixed_point(parts, offset);
    for (int k = 0; k < 3; ++k) {
        const FloatParts origin = parts_of(blob.origin[k]);
        Int128 term;
        if (!to_fixed_point({normal[k].mantissa * origin.mantissa, normal[k].exponent + origin.exponent + to_steps},
                            term))
            return false;
        offset = offset - term;
    }
    offset = (offset + Int128(std::int64_t{1} << (guard_bits - 1))) >> guard_bits;
    plane.offset = Int128(farthest_offset) < offset    ? farthest_offset
                   : offset < Int128(-farthest_offset) ? -farthest_offset
                                                       : static_cast<std::int64_t>(offset.low);
    return true;
}

}  // namespace

QueryStatus round_volume(const BlobData& blob, const ConvexVolume& local, Rounded<ConvexVolume>& set) noexcept {
    if (local.planes.size() > max_planes) return QueryStatus::invalid_argument;
    set.plane_count = 0;
    bool is_empty = false;
    for (const Plane& plane : local.planes) {
        if (!is_finite(plane.normal) || is_nan(plane.offset)) return QueryStatus::invalid_argument;
        const auto parts = [](float x) { return parts_of(flush_subnormal(x)); };
        const FloatParts normal[3] = {parts(plane.normal.x), parts(plane.normal.y), parts(plane.normal.z)};
        if (normal[0].mantissa == 0 && normal[1].mantissa == 0 && normal[2].mantissa == 0)
            return QueryStatus::invalid_argument;
        if (!is_finite(plane.offset)) {
            is_empty = is_empty || is_negative(plane.offset);
            continue;  // or everything is behind it
        }
        LatticePlane rounded;
        if (!round_half_space(blob, normal, plane.offset, rounded)) return QueryStatus::out_of_range;
        set.add_plane(rounded);
    }
    set.bounded = false;
    set.depth_inside = 0;
    return is_empty ? QueryStatus::not_found : QueryStatus::ok;
}

}  // namespace espalier::detail
