#include "steps_maker.hpp"

#include <algorithm>

namespace espalier::tests {

namespace {

LatticePoint steps(const GridPoint& p) { return {p[0], p[1], p[2]}; }

std::string text(const LatticePoint& p) {
    return std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z);
}

/// From one point through another, until an axis ends.
GridPoint beyond(const GridPoint& from, const GridPoint& through) {
    std::int64_t times = 1 << 30;
    for (unsigned k = 0; k < 3; ++k) {
        const std::int64_t way = std::int64_t{through[k]} - from[k];
        const std::int64_t room =
            way > 0 ? std::int64_t{max_lattice_coordinate} - from[k] : max_lattice_coordinate + from[k];
        if (way != 0) times = std::min(times, room / (way < 0 ? -way : way));
    }
    GridPoint result;
    for (unsigned k = 0; k < 3; ++k)
        result[k] = static_cast<std::int32_t>(from[k] + times * (std::int64_t{through[k]} - from[k]));
    return result;
}

}  // namespace

std::int32_t StepsMaker::extent(std::size_t axis) const { return static_cast<std::int32_t>(decoded_.extent[axis]); }

GridPoint StepsMaker::anywhere() {
    GridPoint point;
    for (unsigned k = 0; k < 3; ++k) point[k] = random_.between(-extent(k) / 2 - 1, extent(k) + extent(k) / 2 + 1);
    return point;
}

GridPoint StepsMaker::side_middle() {
    const GridTriangle& triangle = some_triangle();
    GridPoint middle;
    for (unsigned k = 0; k < 3; ++k) middle[k] = (triangle.a[k] + triangle.b[k]) / 2;
    return middle;
}

LatticeBox StepsMaker::box(bool awkward) {
    GridPoint low = awkward ? some_corner() : anywhere();
    GridPoint high = low;
    const std::int32_t part = 1 << random_.below(10);
    for (unsigned k = 0; k < 3; ++k) high[k] += random_.between(0, extent(k) / part + 1);
    if (!awkward) return {steps(low), steps(high)};
    const std::uint32_t axis = random_.below(3);
    const auto kind = random_.below(6);
    if (kind == 0)
        for (unsigned k = 0; k < 3; ++k)
            low[k] -= high[k] - low[k], high[k] = some_corner()[k];  // a corner of it touches, from the other side
    else if (kind == 1) ++low[axis], ++high[axis];                   // a step beside
    else if (kind == 2) high = low;                                  // a point
    else if (kind == 3) high[axis] = low[axis];                      // flat
    else if (kind == 4)
        low[axis] = INT32_MIN, high[axis] = random_.coin() ? INT32_MAX : INT32_MIN;  // all there is, or empty
    return {steps(low), steps(high)};
}

LatticeSegment StepsMaker::segment(bool awkward) {
    GridPoint from = anywhere(), to = anywhere();
    if (!awkward) return {steps(from), steps(to)};
    const std::uint32_t axis = random_.below(3);
    const auto kind = random_.below(8);
    if (kind == 0) to = some_corner();                             // ends at a corner
    else if (kind == 1) to = beyond(from, some_corner());          // through a corner and on
    else if (kind == 2) from = some_corner(), to = some_corner();  // from corner to corner
    else if (kind == 3) {                                          // along an axis, through a corner
        from = some_corner(), to = from;
        from[axis] = random_.between(-extent(axis) - 1, 2 * extent(axis) + 1);
        to[axis] = random_.between(-extent(axis) - 1, 2 * extent(axis) + 1);
    } else if (kind == 4) {  // through a side's middle
        to = beyond(from, side_middle());
    } else if (kind == 5) {  // from as far as may be
        for (std::int32_t& c : from) c = random_.between(-max_lattice_coordinate, max_lattice_coordinate);
        to = random_.coin() ? some_corner() : beyond(from, some_corner());
    } else if (kind == 6) {  // short
        from = some_corner(), to = from;
        for (std::int32_t& c : from) c += random_.between(-3, 3);
        for (std::int32_t& c : to) c += random_.between(-3, 3);
    } else {  // diagonal
        from = some_corner(), to = from;
        for (unsigned k = 0; k < 3; ++k) {
            const std::int32_t way = random_.coin() ? extent(axis) : -extent(axis);
            from[k] -= way, to[k] += way;
        }
    }
    return {steps(from), steps(to)};
}

std::string describe(const LatticeBox& box) { return "box " + text(box.min) + " to " + text(box.max); }
std::string describe(const LatticeSegment& segment) {
    return "segment " + text(segment.from) + " to " + text(segment.to);
}

}  // namespace espalier::tests
