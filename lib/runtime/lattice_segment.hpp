// A segment moved into lattice units and rounded there, once: both ends onto one grid.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <runtime/float_bits.hpp>
#include <runtime/small_code.hpp>

namespace espalier::detail {

/// How far, in lattice steps, an end may be from any point of the asset, along any axis: beyond, a segment is refused.
inline constexpr float segment_reach = 0x1p36f;

/// All that its exact distances need.
struct UnitSegment {
    std::int64_t from[3];  ///< in units of 2^-fraction_bits lattice steps; at most 2^36 of them from the asset
    std::int64_t to[3];
    int fraction_bits;  ///< 0..6
};

struct LatticeSegment : UnitSegment {
    alignas(register_alignment) float from_steps[4];  ///< the same in float and in lattice steps, exactly; the fourth
                                                      ///< is zero
    alignas(register_alignment) float to_steps[4];
};

/// Where `status` is not ok the segment is not written.
ESPALIER_SHARED_CODE inline QueryStatus round_segment(const BlobData& blob, const Segment& world,
                                                      LatticeSegment& segment) {
    const Vec3 ends[2] = {world.from, world.to};
    float steps[2][3];
    float reach = 0.0f;
    for (int end = 0; end < 2; ++end) {
        const float coordinates[3] = {ends[end].x, ends[end].y, ends[end].z};
        for (int k = 0; k < 3; ++k) {
            if (!is_finite(coordinates[k])) return QueryStatus::invalid_argument;
            const float at = (flush_subnormal(coordinates[k]) - blob.origin[k]) * blob.steps_per_unit;
            if (!(absolute(at) < segment_reach)) return QueryStatus::out_of_range;
            steps[end][k] = at;
            reach = maximum(maximum(absolute(at), absolute(blob.extent_steps[k] - at)), reach);
        }
    }
    if (!(reach < segment_reach)) return QueryStatus::out_of_range;
    // As fine as the far end allows, which the near one then shares: floats beyond 2^24 units are integers as they are.
    const int spare = 35 - exponent_of(reach);
    segment.fraction_bits = spare > 6 ? 6 : spare;
    const auto round = [&](const float* from, std::int64_t* units, float* exact) {
        for (int k = 0; k < 3; ++k) {
            const float fine = from[k] * power_of_two(segment.fraction_bits);
            const float rounded = round_to_integer(fine);
            units[k] = to_integer(rounded);
            exact[k] = rounded * power_of_two(-segment.fraction_bits);
        }
        exact[3] = 0.0f;
    };
    round(steps[0], segment.from, segment.from_steps);
    round(steps[1], segment.to, segment.to_steps);
    return QueryStatus::ok;
}

}  // namespace espalier::detail
