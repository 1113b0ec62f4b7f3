// The search for a position that refit() refuses. Reads positions only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/types.hpp>
#include <runtime/base/options.hpp>
#include <runtime/deformation/four_positions.hpp>
#include <runtime/deformation/pose_axis.hpp>

namespace espalier::detail {

template <bool near>
inline bool is_in_range(const PoseAxes& axes, const Vec3& position) {
    return axes.axis[0].coordinate<near>(position.x) <= axes.axis[0].extent &&
           axes.axis[1].coordinate<near>(position.y) <= axes.axis[1].extent &&
           axes.axis[2].coordinate<near>(position.z) <= axes.axis[2].extent;
}

/// Returns the index of the first position that is not finite or out of range, or their number if there is none.
template <bool near>
std::size_t first_refused(const PoseAxes& axes, std::span<const Vec3> positions) {
    std::size_t index = 0;
    if constexpr (near && takes_four_positions)
        while (positions.size() - index >= 4 && are_four_in_range(axes, positions.data() + index)) index += 4;
    while (index < positions.size() && is_in_range<near>(axes, positions[index])) ++index;
    return index;
}

}  // namespace espalier::detail
