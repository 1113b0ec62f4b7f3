// Closest points in the caller's units: rounded, answered in lattice units, translated back.
#include <espalier/nearest.hpp>
#include <runtime/lattice_world.hpp>
#include <runtime/point_queries.hpp>
#include <runtime/simd/dispatch.hpp>

namespace espalier {

using namespace detail;

bool closest_point(const Blob& blob, Vec3 point, float max_distance, Nearest& nearest) noexcept {
    LatticePoint rounded;
    FoundNearest found;
    if (blob.triangle_count() == 0 || !round_point(blob.data(), point, max_distance, rounded)) return false;
    if (!ESPALIER_DISPATCH(closest_triangle, blob.data(), rounded, found)) return false;
    const float u = found.distance.u;
    const float v = found.distance.v;
    float on_surface[3];
    for (int k = 0; k < 3; ++k) {
        const auto& corner = found.triangle.corner;
        const float ab = static_cast<float>(corner[1][k] - corner[0][k]);
        const float ac = static_cast<float>(corner[2][k] - corner[0][k]);
        on_surface[k] = static_cast<float>(corner[0][k]) + (u * ab + v * ac);
    }
    const float steps = square_root(found.distance.squared) + rounded.distance_offset;
    const float distance = scale_by_power_of_two(steps, blob.data().step_exponent);
    // That it is within max_distance was decided exactly; rounding must not say otherwise.
    nearest = {to_world(blob.data(), on_surface[0], on_surface[1], on_surface[2]),
               magnitude_bits(distance) > magnitude_bits(max_distance) ? max_distance : distance, u, v,
               Triangle{found.index}};
    return true;
}

}  // namespace espalier
