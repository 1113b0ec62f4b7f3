// The kernel of capsules and of closest segments. Widths and roundings: docs/numerics.md.
#include <runtime/kernels/segment_places.hpp>

namespace espalier::detail {

SegmentDistance distance_to(const UnitSegment& segment, const LatticeTriangle& triangle) noexcept {
    SegmentPlaces places(segment.fraction_bits);
    places.try_all(segment, triangle);
    return places.nearest();
}

bool is_within_radius(const UnitSegment& segment, const LatticeTriangle& triangle, const SegmentDistance& distance,
                      float radius) noexcept {
    const int sure = sure_within(distance.squared, radius);
    if (sure > 0) return true;
    if (radius == 0.0f || (sure < 0 && distance.squared != least_squared)) return false;
    SegmentPlaces places(segment.fraction_bits, radius);
    places.try_all(segment, triangle);
    return places.is_any_within();
}

}  // namespace espalier::detail
