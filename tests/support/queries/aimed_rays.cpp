#include "aimed_rays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/base/hostile_values.hpp"
#include "support/base/vectors.hpp"

namespace espalier::tests {

namespace {

using Point = std::array<double, 3>;

Point at(const GridPoint& p) {
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}
/// from + share * (to - from)
Point between(const Point& from, const Point& to, double share) {
    return {from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1]),
            from[2] + share * (to[2] - from[2])};
}
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double length(const Point& a) { return std::sqrt(dot(a, a)); }

struct Bounds {
    Point low = {1e300, 1e300, 1e300};
    Point high = {-1e300, -1e300, -1e300};
};

Bounds bounds_of(const std::vector<GridTriangle>& triangles) {
    Bounds bounds;
    for (const GridTriangle& t : triangles)
        for (const GridPoint& p : {t.a, t.b, t.c})
            for (unsigned k = 0; k < 3; ++k) {
                bounds.low[k] = std::min(bounds.low[k], static_cast<double>(p[k]));
                bounds.high[k] = std::max(bounds.high[k], static_cast<double>(p[k]));
            }
    return bounds;
}

constexpr double surely = 0x1p-10;  // lattice steps: far more than the errors of double here

}  // namespace

AimedRays::AimedRays(const ExtremeSolid& solid, std::uint64_t seed)
    : solid_(solid), random_(seed), step_(std::ldexp(1.0, solid.shape.decoded.step_exponent)) {
    const Bounds bounds = bounds_of(solid.surface);
    size_ = length(minus(bounds.high, bounds.low));
}

Vec3 AimedRays::to_world(const Point& steps) const {
    const auto axis = [&](unsigned k) {
        return static_cast<float>(static_cast<double>(solid_.shape.decoded.origin[k]) + steps[k] * step_);
    };
    return {axis(0), axis(1), axis(2)};
}

const GridTriangle& AimedRays::face() {
    return solid_.surface[random_.below(static_cast<std::uint32_t>(solid_.surface.size()))];
}

/// Between the middle and some corner.
AimedRays::Point AimedRays::inside() {
    return between(solid_.middle, at(face().a), 0.9 * static_cast<double>(random_.unit()));
}

AimedRays::Point AimedRays::on_side(const GridTriangle& triangle) {
    const GridPoint* corners[3] = {&triangle.a, &triangle.b, &triangle.c};
    const std::uint32_t first = random_.below(3);
    const std::uint32_t kind = random_.below(3);
    const double share = kind == 0 ? 0.0 : kind == 1 ? 0.5 : static_cast<double>(random_.unit());
    return between(at(*corners[first]), at(*corners[(first + 1) % 3]), share);
}

/// Up to three ulp to either side in half of the calls.
float AimedRays::nudged(float value) {
    if (random_.coin()) return value;
    const std::int32_t by = random_.between(-3, 3);
    for (std::int32_t i = 0; i < std::abs(by); ++i) value = std::nextafter(value, by < 0 ? -INFINITY : INFINITY);
    return value;
}

void AimedRays::set_length_and_window(Ray& ray) {
    const double longest =
        std::max({std::fabs(static_cast<double>(ray.direction.x)), std::fabs(static_cast<double>(ray.direction.y)),
                  std::fabs(static_cast<double>(ray.direction.z))});
    // The window in lengths of the direction, which leads from the origin to a point inside or beyond the surface.
    double t_min = 0.0;
    double t_max = std::numeric_limits<double>::infinity();
    const auto kind = random_.below(8);
    if (kind == 0) t_max = 1.0;
    else if (kind == 1) t_min = 1.0;
    else if (kind == 2) t_min = static_cast<double>(random_.unit());
    else if (kind == 3) t_max = 1e30;
    else if (kind == 4) t_max = 2.0 * static_cast<double>(random_.unit());
    double factor = 1.0;
    const int exponent = longest > 0.0 && std::isfinite(longest) ? std::ilogb(longest) : 0;
    const auto choice = random_.below(8);
    if (choice == 0) factor = std::ldexp(1.0, -exponent);            // of about 1
    else if (choice == 1) factor = std::ldexp(1.0, 127 - exponent);  // as large as floats are
    else if (choice == 2)
        factor = std::ldexp(1.0, -140 + random_.between(0, 13) - exponent);  // subnormal, with few bits left
    else if (choice == 3) factor = std::ldexp(1.0, random_.between(-120, 120) - exponent);
    const auto scaled = [&](float x) { return nudged(static_cast<float>(static_cast<double>(x) * factor)); };
    ray.direction = {scaled(ray.direction.x), scaled(ray.direction.y), scaled(ray.direction.z)};
    const auto rounded = [&](double t) {
        return t > 0x1p127 * factor ? std::numeric_limits<float>::infinity() : static_cast<float>(t / factor);
    };
    ray.t_min = rounded(t_min);
    ray.t_max = rounded(t_max);
    if (random_.below(8) == 0) ray.t_max = std::numeric_limits<float>::max();
}

Ray AimedRays::ray(Aim aim) {
    const GridTriangle& triangle = face();
    const Point target = on_side(triangle);
    Point goal = inside();
    Point from = goal;
    double away = std::ldexp(1.0, random_.between(-20, 4)) * (1.0 + static_cast<double>(random_.unit()));
    switch (aim) {
        case Aim::from_inside:
            goal = target;
            break;
        case Aim::far:
            away = size_ * std::pow(10.0, 2.0 + 5.0 * static_cast<double>(random_.unit())) /
                   std::max(length(minus(target, goal)), 1.0);
            from = between(target, goal, -away);
            break;
        case Aim::axis_parallel: {
            const std::uint32_t axis = random_.below(3);
            away = size_ * std::pow(10.0, -1.0 + 8.0 * static_cast<double>(random_.unit()));
            from = goal = target;
            const bool up = random_.coin();
            from[axis] += up ? -away : away;
            goal[axis] = solid_.middle[axis];
            Ray ray;
            const Vec3 begin = to_world(from), end = to_world(goal);
            ray.origin = {nudged(begin.x), nudged(begin.y), nudged(begin.z)};
            ray.direction = {axis == 0        ? end.x - begin.x
                             : random_.coin() ? 0.0f
                                              : -0.0f,
                             axis == 1 ? end.y - begin.y : 0.0f, axis == 2 ? end.z - begin.z : 0.0f};
            set_length_and_window(ray);
            // What is nudged off the axis is parallel no more; subnormal is what it is then.
            if (random_.coin()) {
                if (axis != 0) ray.direction.x = 0.0f;
                if (axis != 1) ray.direction.y = 0.0f;
                if (axis != 2) ray.direction.z = -0.0f;
            }
            return ray;
        }
        case Aim::grazing: {
            const Point middle_of_face =
                between(between(at(triangle.a), at(triangle.b), 0.5), at(triangle.c), 1.0 / 3.0);
            const double below = std::pow(10.0, -7.0 + 4.0 * static_cast<double>(random_.unit()));
            goal = between(middle_of_face, solid_.middle, below);
            from = between(target, goal, -away);
            if (random_.below(4) == 0) std::swap(from, goal);
            break;
        }
        default:
            from = between(target, goal, -away);
    }
    Ray ray = {.origin = to_world(from), .direction = {}};
    if (aim != Aim::far) ray.origin = {nudged(ray.origin.x), nudged(ray.origin.y), nudged(ray.origin.z)};
    ray.direction = difference(to_world(goal), ray.origin);
    set_length_and_window(ray);
    return ray;
}

Ray AimedRays::hostile_ray() {
    Ray ray = this->ray(static_cast<Aim>(random_.below(static_cast<std::uint32_t>(Aim::count))));
    const auto numbers = numbers_of(ray);
    for (std::uint32_t i = 1 + random_.below(2); i > 0; --i)
        *numbers[random_.below(8)] = hostile_values[random_.below(hostile_values.size())];
    if (random_.below(8) == 0) ray.direction = {0.0f, -0.0f, 0.0f};
    return ray;
}

HitProof::HitProof(const ExtremeSolid& solid) : step_(std::ldexp(1.0, solid.shape.decoded.step_exponent)) {
    for (const GridTriangle& t : solid.surface) {
        const Point a = at(t.a), ab = minus(at(t.b), a), ac = minus(at(t.c), a);
        const Point normal = {ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2],
                              ab[0] * ac[1] - ab[1] * ac[0]};
        faces_.push_back({normal, dot(normal, a), length(normal)});
    }
    const Bounds bounds = bounds_of(solid.surface);
    low_ = bounds.low;
    high_ = bounds.high;
    for (unsigned k = 0; k < 3; ++k) world_origin_[k] = static_cast<double>(solid.shape.decoded.origin[k]);
}

HitProof::Stretch HitProof::inside(const Point& origin, const Point& direction, double margin) const {
    Stretch stretch = {-1e300, 1e300};
    for (const Face& face : faces_) {
        const double depth = face.offset - margin * face.width - dot(face.normal, origin);  // inside: above 0
        const double speed = dot(face.normal, direction);
        if (speed > 0.0) stretch.to = std::min(stretch.to, depth / speed);
        else if (speed < 0.0) stretch.from = std::max(stretch.from, depth / speed);
        else if (!(depth > 0.0)) return {0.0, -1.0};
    }
    return stretch;
}

bool HitProof::is_outside(const Point& point) const {
    for (unsigned k = 0; k < 3; ++k)
        if (point[k] < low_[k] - surely || point[k] > high_[k] + surely) return true;
    return false;
}

HitProof::Crossing HitProof::crossing(const detail::LatticeRay& ray) const {
    Point origin{}, direction{};
    for (unsigned k = 0; k < 3; ++k) {
        origin[k] = std::ldexp(ray.origin[k], -ray.fraction_bits);
        direction[k] = ray.direction[k];
    }
    const auto tau_min = static_cast<double>(ray.tau_min), tau_max = static_cast<double>(ray.tau_max);
    const auto along = [&](double tau) {
        return Point{origin[0] + tau * direction[0], origin[1] + tau * direction[1], origin[2] + tau * direction[2]};
    };
    const Stretch stretch = inside(origin, direction, surely);
    if (!(std::max(stretch.from, tau_min) <= std::min(stretch.to, tau_max))) return Crossing::unproved;
    constexpr double beyond_everything = 0x1p10;  // directions are 2^23 steps long and more
    if (tau_max > beyond_everything || is_outside(along(tau_max))) return Crossing::leaves;
    return is_outside(along(tau_min)) ? Crossing::enters : Crossing::unproved;
}

bool HitProof::must_not_pass_by(const Ray& ray) const {
    const float from[3] = {ray.origin.x, ray.origin.y, ray.origin.z};
    const float way[3] = {ray.direction.x, ray.direction.y, ray.direction.z};
    Point origin{}, direction{};
    double longest = 0.0, away = 0.0;
    int still = 0;
    for (unsigned k = 0; k < 3; ++k) {
        origin[k] = (static_cast<double>(from[k]) - world_origin_[k]) / step_;
        direction[k] = static_cast<double>(way[k]);
        longest = std::max(longest, std::fabs(direction[k]));
        away = std::max(away, std::fabs(origin[k]));
        still += way[k] == 0.0f ? 1 : 0;
    }
    // A difference of coordinates that float32 does not hold is refused, as is what is 2^120 steps away.
    if (!(longest > 0.0 && longest <= 0x1p127 && away < 0x1p100 && away * step_ < 0x1p127)) return false;
    if (!(ray.t_min <= 0.0f && ray.t_max == std::numeric_limits<float>::infinity())) return false;
    for (double& x : direction) x /= longest;
    // 2^-20 of the way, which is 16 roundings; along an axis nothing moves the ray sideways.
    const double lost = still == 2 ? 1.0 : 1.0 + (away + 0x1p25) * 0x1p-20;
    const Stretch stretch = inside(origin, direction, lost);
    return std::max(stretch.from, 0.0) < stretch.to;
}

}  // namespace espalier::tests
