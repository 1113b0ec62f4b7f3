#include <baker/input/positions.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <baker/base/float_rounding.hpp>

namespace espalier::baker {

namespace {

constexpr double beyond_float32 = 0x1.ffffffp127;  // from here on the nearest float32 is infinite
constexpr double hardly_zero = 0x1p-200;           // products of larger numbers do not underflow in float64

}  // namespace

Vec3d given_position(const MeshView& mesh, std::size_t number) {
    return mesh.float64_positions.empty() ? to_float64(mesh.positions[number]) : mesh.float64_positions[number];
}

double PositionsFromOrigin::subtract(double given, double origin, double& error) const {
    const double difference = given - origin;
    if (!std::isfinite(difference)) return difference;
    if (std::abs(difference) >= beyond_float32)
        return std::copysign(std::numeric_limits<double>::infinity(), difference);
    // What the subtraction lost, exactly (Knuth's two-sum).
    const double of_given = difference + origin, of_origin = of_given - difference;
    error = (given - of_given) - (origin - of_origin);
    double kept = as_float32_ ? double(static_cast<float>(difference)) : difference;
    if (std::abs(kept) < hardly_zero) kept = 0.0;
    error += difference - kept;
    return kept;
}

Vec3d PositionsFromOrigin::at(const Vec3d& given) {
    Vec3d error;
    const Vec3d point = {subtract(given.x, origin_.x, error.x), subtract(given.y, origin_.y, error.y),
                         subtract(given.z, origin_.z, error.z)};
    if (is_finite(point))
        largest_square_ = std::max(largest_square_, error.x * error.x + error.y * error.y + error.z * error.z);
    return point;
}

double PositionsFromOrigin::moved() const { return std::sqrt(largest_square_) * (1.0 + 0x1p-50); }

}  // namespace espalier::baker
