// Volumes in the caller's units: rounded, answered in lattice units.
#include <espalier/overlap.hpp>
#include <runtime/point_queries.hpp>
#include <runtime/simd/dispatch.hpp>

namespace espalier {

using namespace detail;

bool overlaps(const Blob& blob, const Sphere& sphere) noexcept {
    LatticePoint rounded;
    return blob.triangle_count() != 0 && round_point(blob.data(), sphere.center, sphere.radius, rounded) &&
           ESPALIER_DISPATCH(any_overlap, blob.data(), rounded);
}

bool for_each_overlap(const Blob& blob, const Sphere& sphere, FunctionRef<Visit(Triangle)> visit) {
    LatticePoint rounded;
    if (blob.copy_count() != 0) return false;
    if (blob.triangle_count() == 0 || !round_point(blob.data(), sphere.center, sphere.radius, rounded)) return true;
    return ESPALIER_DISPATCH(every_overlap, blob.data(), rounded, visit);
}

}  // namespace espalier
