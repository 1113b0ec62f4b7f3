#include <import/base/placement.hpp>

#include <algorithm>
#include <cmath>

namespace espalier {

Vec3 Placement::operator()(const std::array<double, 3>& point) const {
    std::array<float, 3> result{};
    for (std::size_t row = 0; row < 3; ++row) {
        double sum = 0.0;
        for (std::size_t column = 0; column < 3; ++column)
            if (linear[row][column] != 0.0) sum += linear[row][column] * point[column];  // 0 times infinity is NaN
        result[row] = static_cast<float>(sum + offset[row]);
    }
    return {result[0], result[1], result[2]};
}

Vec3 Placement::operator()(Vec3 point) const {
    return (*this)(
        std::array{static_cast<double>(point.x), static_cast<double>(point.y), static_cast<double>(point.z)});
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

bool is_finite(Vec3 point) { return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z); }

void PointBox::add(const std::array<double, 3>& point) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], point[axis]);
        high[axis] = std::max(high[axis], point[axis]);
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
