#include "agreement.hpp"

#include <cmath>

#include "hit_geometry.hpp"

namespace espalier::bench {

Agreement compare(const std::vector<Ray>& rays, const std::vector<Hit>& reference, const std::vector<Hit>& own,
                  double max_error, double size) {
    // 32 half units in the last place of a coordinate: what a few float32 operations lose.
    const double rounding = 0x1p-19 * size;
    Agreement agreement;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (reference[i].found != own[i].found) ++agreement.disagreeing;
        if (!reference[i].found || !own[i].found) continue;
        // Measured across the surface: along a ray that grazes it, a small distance becomes a long one. Embree's
        // normals are not of length 1, ours and the ray's are.
        const Vec3 normal = reference[i].normal;
        const double length = std::sqrt(static_cast<double>(dot(normal, normal)));
        const double slope =
            length > 0.0 ? std::abs(static_cast<double>(dot(normal, rays[i].direction))) / length : 1.0;
        const double apart = std::abs(static_cast<double>(own[i].t) - static_cast<double>(reference[i].t));
        // Not "apart * slope > ...": a NaN disagrees.
        if (!(apart * slope <= max_error + rounding)) ++agreement.t_disagreeing;
    }
    return agreement;
}

std::size_t contradictions(const std::vector<Hit>& closest, const std::vector<std::uint8_t>& any) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < closest.size(); ++i) count += closest[i].found != (any[i] != 0);
    return count;
}

}  // namespace espalier::bench
