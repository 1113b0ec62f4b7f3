#include "measure_error.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace espalier::baker {

namespace {

/// The distance between coordinate and its lattice coordinate, correctly rounded: the difference of coordinate and origin is
/// taken as a sum without rounding error (two-sum), of which the lattice part is subtracted exactly.
double snap_error(float coordinate, float origin, double reciprocal_step, double step) {
    const double a = double{coordinate};
    const double b = -double{origin};
    const double sum = a + b;
    const double virtual_part = sum - a;
    const double lost = (a - (sum - virtual_part)) + (b - virtual_part);
    return (sum - round_half_even(sum * reciprocal_step) * step) + lost;
}

float round_up_to_float(double value) {
    auto rounded = static_cast<float>(value);
    if (double{rounded} < value) rounded = std::bit_cast<float>(std::bit_cast<std::uint32_t>(rounded) + 1);
    return rounded != 0.0f ? std::max(rounded, std::numeric_limits<float>::min()) : rounded;
}

}  // namespace

float measure_error(const Source& source, const LatticeMesh& mesh) {
    const Vec3 origin = mesh.lattice.origin;
    const double step = mesh.lattice.step();
    const double reciprocal_step = 1.0 / step;
    double largest = 0.0;
    for (const SourceTriangle& triangle : source.triangles) {
        for (const std::uint32_t corner : triangle.corners) {
            const Vec3& point = source.positions[corner];
            const double x = snap_error(point.x, origin.x, reciprocal_step, step);
            const double y = snap_error(point.y, origin.y, reciprocal_step, step);
            const double z = snap_error(point.z, origin.z, reciprocal_step, step);
            largest = std::max(largest, x * x + y * y + z * z);
        }
    }
    return round_up_to_float(std::sqrt(largest) * (1.0 + 0x1p-50));
}

}  // namespace espalier::baker
