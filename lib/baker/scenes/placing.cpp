#include <baker/scenes/placing.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <baker/base/origin_choice.hpp>

namespace espalier::baker {

namespace {

DoubleSum sum_of(double a, double b) {
    const double high = a + b, of_a = high - b, of_b = high - of_a;
    return {high, (a - of_a) + (b - of_b)};
}

DoubleSum product_of(double a, double b) {
    const double high = a * b;
    return {high, std::fma(a, b, -high)};
}

}  // namespace

DoubleSum operator+(const DoubleSum& a, const DoubleSum& b) {
    const DoubleSum high = sum_of(a.high, b.high), low = sum_of(a.low, b.low);
    const DoubleSum most = sum_of(high.high, high.low + low.high);
    return sum_of(most.high, most.low + low.low);
}

DoubleSum operator-(const DoubleSum& a) { return {-a.high, -a.low}; }

DoubleSum operator*(const DoubleSum& a, double b) {
    const DoubleSum high = product_of(a.high, b);
    return sum_of(high.high, high.low + a.low * b);
}

DoubleSum operator/(const DoubleSum& a, const DoubleSum& b) {
    const double first = a.high / b.high;
    const DoubleSum rest = a + -(b * first);
    const double second = rest.high / b.high;
    const double third = (rest + -(b * second)).high / b.high;
    return sum_of(first, second) + DoubleSum{third};
}

namespace {

/// Rounds once: where the low part decides, the high part becomes the neighbour with an odd last bit, which no float32
/// and no middle between two of them has.
float to_float32(const DoubleSum& number) {
    constexpr double beyond_float32 = 0x1.ffffffp127;  // from here on the nearest float32 is infinite
    if (!(std::abs(number.high) < beyond_float32)) return std::numeric_limits<float>::infinity();
    auto bits = std::bit_cast<std::uint64_t>(number.high);
    if (number.low != 0.0 && (bits & 1) == 0) {
        const bool is_toward_zero = std::signbit(number.low) != std::signbit(number.high);
        bits += is_toward_zero ? ~std::uint64_t{0} : 1;
    }
    return static_cast<float>(std::bit_cast<double>(bits)) + 0.0f;  // not -0
}

bool is_still(const Quaternion& q) { return q.x == 0.0f && q.y == 0.0f && q.z == 0.0f; }

/// Returns rotation * (scale * point).
std::array<DoubleSum, 3> turned(const Transform& transform, const Vec3d& point) {
    const Quaternion& q = transform.rotation;
    const double coordinates[3] = {point.x, point.y, point.z};
    std::array<DoubleSum, 3> result;
    if (is_still(q)) {
        for (std::size_t i = 0; i < 3; ++i) result[i] = product_of(coordinates[i], double(transform.scale));
        return result;
    }
    // Products of float32 numbers are exact.
    const auto x = double(q.x), y = double(q.y), z = double(q.z), w = double(q.w);
    const auto squares = [](double a, double b, double c, double d) { return sum_of(a, b) + sum_of(c, d); };
    const DoubleSum rows[3][3] = {
        {squares(w * w, x * x, -y * y, -z * z), sum_of(2 * x * y, -2 * w * z), sum_of(2 * x * z, 2 * w * y)},
        {sum_of(2 * x * y, 2 * w * z), squares(w * w, -x * x, y * y, -z * z), sum_of(2 * y * z, -2 * w * x)},
        {sum_of(2 * x * z, -2 * w * y), sum_of(2 * y * z, 2 * w * x), squares(w * w, -x * x, -y * y, z * z)}};
    const DoubleSum square = squares(x * x, y * y, z * z, w * w);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) result[i] = result[i] + rows[i][k] * coordinates[k];
        result[i] = result[i] / square * double(transform.scale);
    }
    return result;
}

double size_of(const Vec3d& point) { return std::abs(point.x) + std::abs(point.y) + std::abs(point.z); }

}  // namespace

ExactPlace::ExactPlace(const Transform& transform, const Vec3d& translation, const Vec3d& origin)
    : sum_{DoubleSum{translation.x}, DoubleSum{translation.y}, DoubleSum{translation.z}}, slack_(0.0) {
    if (origin == Vec3d{}) return;
    const std::array<DoubleSum, 3> of_origin = turned(transform, origin);
    for (std::size_t k = 0; k < 3; ++k) sum_[k] = sum_[k] + of_origin[k];
    if (!is_still(transform.rotation))
        slack_ = 0x1p-96 * (size_of(translation) + double(transform.scale) * size_of(origin));
}

Vec3 ExactPlace::seen_from(const Vec3d& origin, double& moved) const {
    const double from[3] = {origin.x, origin.y, origin.z};
    Vec3 place;
    float* const coordinates[3] = {&place.x, &place.y, &place.z};
    double square = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const DoubleSum exact = sum_[k] + DoubleSum{-from[k]};
        *coordinates[k] = to_float32(exact);
        const DoubleSum lost = exact + DoubleSum{-double(*coordinates[k])};
        square += lost.high * lost.high;
    }
    moved = (std::sqrt(square) + slack_) * (1.0 + 0x1p-50);
    return place;
}

namespace {

double farthest_coordinate(const WorldBox& box, const Vec3d& origin) {
    const double from[3] = {origin.x, origin.y, origin.z};
    double farthest = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
        farthest = std::max({farthest, std::abs(box.lo[k] - from[k]), std::abs(box.hi[k] - from[k])});
    return farthest;
}

}  // namespace

std::optional<std::size_t> find_too_far(std::span<const PlacedBox> instances, const Vec3d& origin) {
    const auto found = std::find_if(instances.begin(), instances.end(), [&](const PlacedBox& instance) {
        return instance.is_in_float64 && is_too_coarse(farthest_coordinate(instance.box, origin), instance.step);
    });
    if (found == instances.end()) return std::nullopt;
    return static_cast<std::size_t>(found - instances.begin());
}

Vec3d choose_scene_origin(std::span<const PlacedBox> instances) {
    const auto is_near = [&](const Vec3d& origin) {
        return std::ranges::none_of(instances, [&](const PlacedBox& instance) {
            return is_too_coarse(farthest_coordinate(instance.box, origin), instance.step);
        });
    };
    if (is_near({})) return {};
    WorldBox all = instances.front().box;
    double side = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        for (const PlacedBox& instance : instances) {
            all.lo[k] = std::min(all.lo[k], instance.box.lo[k]);
            all.hi[k] = std::max(all.hi[k], instance.box.hi[k]);
        }
        side = std::max(side, all.hi[k] - all.lo[k]);
    }
    if (!std::isfinite(side)) return {};
    const auto origin_on = [&](double grid) {
        return origin_near_middle({all.lo[0], all.lo[1], all.lo[2]}, {all.hi[0], all.hi[1], all.hi[2]}, grid);
    };
    const double largest = farthest_coordinate(all, {});
    if (!find_too_far(instances, {})) {
        // float32 holds all instances, and only places near them are rounded: from here on a thousandth as far, or as
        // is enough. A round number is the origin of most views of moving scenes too. About 0 it is 0.
        const double least = power_above(side);
        for (double grid = std::ldexp(power_above(largest), -10); grid > least; grid /= 2)
            if (const Vec3d origin = origin_on(grid); is_near(origin)) return origin;
        return origin_on(least);
    }
    double spacing = side > 0.0 ? power_above(side / 64) : 0.0;
    for (const PlacedBox& instance : instances)
        if (std::isfinite(instance.step)) spacing = std::max(spacing, power_above(instance.step));
    // A moving scene that reaches this far has views on a grid of 2^-23 of the coordinate at the finest.
    const Vec3d of_view = origin_on(std::max(spacing, std::ldexp(power_above(largest), -22)));
    return find_too_far(instances, of_view) ? origin_on(spacing) : of_view;
}

}  // namespace espalier::baker
