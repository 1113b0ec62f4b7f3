// A segment moved into lattice units and rounded there, once: both ends onto one grid.
#pragma once

#include <runtime/lattice/rounder.hpp>

namespace espalier::detail {

/// All that its exact distances need.
struct UnitSegment {
    Integer3 from;  ///< in units of 2^-fraction_bits lattice steps; at most 2^36 of them from the asset
    Integer3 to;
    int fraction_bits;  ///< 0..6
};

struct RoundedSegment : UnitSegment {
    alignas(register_alignment) float from_steps[4];  ///< the same in float and in lattice steps, exactly; the fourth
                                                      ///< is zero
    alignas(register_alignment) float to_steps[4];
};

/// Where `status` is not ok the segment is not written.
ESPALIER_SHARED_CODE inline QueryStatus round_segment(const BlobData& blob, const Segment& local,
                                                      RoundedSegment& segment) {
    const float coordinates[6] = {local.from.x, local.from.y, local.from.z, local.to.x, local.to.y, local.to.z};
    float steps[6];
    Rounder rounder(blob);
    for (int i = 0; i < 6; ++i) {
        const int k = i < 3 ? i : i - 3;
        if (!is_finite(coordinates[i])) return QueryStatus::invalid_argument;
        steps[i] = to_steps(blob, k, coordinates[i]);
        if (!(absolute(steps[i]) < shape_reach)) return QueryStatus::out_of_range;
        rounder.extend(rounder.distance(k, steps[i]));
    }
    if (!(rounder.reach() < shape_reach)) return QueryStatus::out_of_range;
    // As fine as the far end allows; the near end shares that grid.
    segment.fraction_bits = fraction_bits_for(rounder.reach(), segment_grid);
    to_grid(steps, segment.fraction_bits, segment.from, segment.from_steps);
    to_grid(steps + 3, segment.fraction_bits, segment.to, segment.to_steps);
    return QueryStatus::ok;
}

}  // namespace espalier::detail
