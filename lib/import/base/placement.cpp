#include <import/base/placement.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier {

Vec3d Placement::operator()(const Vec3d& point) const {
    const std::array<double, 3> coordinates{point.x, point.y, point.z};
    std::array<double, 3> result{};
    for (std::size_t row = 0; row < 3; ++row) {
        double sum = 0.0;
        for (std::size_t column = 0; column < 3; ++column)
            if (linear[row][column] != 0.0) sum += linear[row][column] * coordinates[column];  // 0 * infinity is NaN
        result[row] = sum + offset[row];
    }
    return {result[0], result[1], result[2]};
}

double Placement::determinant() const {
    const auto& m = linear;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

bool Placement::mirrors() const { return determinant() < 0.0; }

}  // namespace espalier

namespace espalier::importer {

const char* axis_name(Axis axis) { return axis == Axis::x ? "+X" : axis == Axis::y ? "+Y" : "+Z"; }

float to_float32(double number) {
    constexpr double beyond = 0x1.ffffffp127;  // from here on the nearest one is infinite
    if (std::abs(number) < beyond || std::isnan(number)) return static_cast<float>(number);
    return number < 0.0 ? -std::numeric_limits<float>::infinity() : std::numeric_limits<float>::infinity();
}

bool is_finite(Vec3 point) { return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z); }
bool is_finite(const Vec3d& point) { return is_finite(to_float32(point)); }

void PointBox::add(const Vec3d& point) {
    const std::array<double, 3> coordinates{point.x, point.y, point.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], coordinates[axis]);
        high[axis] = std::max(high[axis], coordinates[axis]);
    }
}

Placement combine(const Placement& outer, const Placement& inner) {
    Placement result;
    for (std::size_t row = 0; row < 3; ++row) {
        result.offset[row] = outer.offset[row];
        for (std::size_t column = 0; column < 3; ++column) {
            result.linear[row][column] = outer.linear[row][0] * inner.linear[0][column] +
                                         outer.linear[row][1] * inner.linear[1][column] +
                                         outer.linear[row][2] * inner.linear[2][column];
            result.offset[row] += outer.linear[row][column] * inner.offset[column];
        }
    }
    return result;
}

Placement scaled_by(double factor) {
    Placement result;
    for (std::size_t axis = 0; axis < 3; ++axis) result.linear[axis][axis] = factor;
    return result;
}

Placement turned_to_y_up(Axis up) {
    Placement result;
    if (up == Axis::z) result.linear = {{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}};
    if (up == Axis::x) result.linear = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
    return result;
}

}  // namespace espalier::importer
