// Boxes of lattice coordinates, four lanes at a time. Coordinates are below 2^24, which float32 holds exactly, so
// minima and maxima are exact on every machine; the compiler's vector types become the machine's own instructions where
// it has them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <espalier/types.hpp>
#include <runtime/base/vector.hpp>

namespace espalier::baker {

using Lanes = detail::Vector<float, 4>;
using IntegerLanes = detail::Vector<std::int32_t, 4>;

[[nodiscard]] inline Lanes smaller(Lanes a, Lanes b) { return a < b ? a : b; }
[[nodiscard]] inline Lanes larger(Lanes a, Lanes b) { return a > b ? a : b; }

/// A box in lanes x, y, z; the fourth lane carries nothing.
struct LaneBox {
    Lanes lo = {infinity, infinity, infinity, infinity};
    Lanes hi = {-infinity, -infinity, -infinity, -infinity};

    void add(Lanes low, Lanes high) {
        lo = smaller(lo, low);
        hi = larger(hi, high);
    }
    void add(Lanes point) { add(point, point); }
    void add(const LaneBox& box) { add(box.lo, box.hi); }

    /// Returns half the surface. The box must not be empty: its result would be infinity or NaN.
    [[nodiscard]] float half_area() const {
        const Lanes side = hi - lo;
        return side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
    }
};
static_assert(sizeof(LaneBox) == 32);

/// The box in a struct of two corners of three floats, each followed by 4 bytes of something else.
template <class Struct>
[[nodiscard]] LaneBox lane_box_of(const Struct& from) {
    static_assert(sizeof(Struct) == sizeof(LaneBox) && offsetof(Struct, lo) == 0 && offsetof(Struct, hi) == 16);
    // The fourth lanes are cleared: whole numbers read as floats are denormal, with which some machines are slow.
    constexpr IntegerLanes keep = {-1, -1, -1, 0};
    IntegerLanes corners[2];
    std::memcpy(corners, &from, sizeof corners);
    corners[0] &= keep;
    corners[1] &= keep;
    LaneBox box;
    std::memcpy(&box, corners, sizeof box);
    return box;
}

}  // namespace espalier::baker
