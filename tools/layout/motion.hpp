// How the vertices of a deformable blob may move.
#pragma once

#include <espalier/blob.hpp>

#include "report/json_output.hpp"

namespace espalier::tools {

/// The figures of a deformable blob.
struct Motion {
    std::uint32_t positions = 0;   ///< that refit() takes
    Box range;                     ///< in which they must lie
    std::size_t moving_bytes = 0;  ///< in the caller's memory; the rest may stay in flash
};

Motion motion_of(const Blob& blob);

/// Returns the keys positions, range, moving_bytes and moving_bytes_per_triangle.
Json motion_json(const Blob& blob);

}  // namespace espalier::tools
