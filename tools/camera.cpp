#include "camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::tools {

namespace {

constexpr double field_of_view = 32.0;  // degrees, of the shorter side
constexpr float margin = 1.06f;

float radians(double degrees) { return static_cast<float>(degrees * std::numbers::pi / 180.0); }

/// From axes in which +Y is up to axes in which `up` is.
Vec3 turned(Vec3 a, Axis up) {
    if (up == Axis::z) return {a.x, -a.z, a.y};
    if (up == Axis::x) return {a.y, -a.x, a.z};
    return a;
}

}  // namespace

Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator*(float factor, Vec3 a) { return {factor * a.x, factor * a.y, factor * a.z}; }
float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Vec3 normalized(Vec3 a) { return (1.0f / std::sqrt(dot(a, a))) * a; }

View view_from(Axis up, double azimuth, double elevation) {
    const float around = radians(azimuth);
    const float above = radians(elevation);
    const Vec3 towards{std::sin(around) * std::cos(above), std::sin(above), std::cos(around) * std::cos(above)};
    const Vec3 right{std::cos(around), 0.0f, -std::sin(around)};
    return {turned(right, up), turned(cross(towards, right), up), turned(towards, up)};
}

Camera::Camera(const View& view, Vec3 box_min, Vec3 box_max, unsigned width, unsigned height)
    : view_(view),
      width_(static_cast<float>(width)),
      height_(static_cast<float>(height)) {
    const float half = std::tan(0.5f * radians(field_of_view));
    const float shorter = std::min(width_, height_);
    half_width_ = half * width_ / shorter;
    half_height_ = half * height_ / shorter;
    const Vec3 middle = 0.5f * (box_min + box_max);
    float distance = 0.0f;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vec3 point{(corner & 1) != 0 ? box_max.x : box_min.x, (corner & 2) != 0 ? box_max.y : box_min.y,
                         (corner & 4) != 0 ? box_max.z : box_min.z};
        const Vec3 offset = point - middle;
        const float nearer = dot(offset, view_.towards);
        distance = std::max({distance, nearer + margin * std::abs(dot(offset, view_.right)) / half_width_,
                             nearer + margin * std::abs(dot(offset, view_.up)) / half_height_});
    }
    eye_ = middle + distance * view_.towards;
}

Ray Camera::ray(float column, float row) const {
    const float across = half_width_ * (2.0f * column / width_ - 1.0f);
    const float upwards = half_height_ * (1.0f - 2.0f * row / height_);
    Ray ray;
    ray.origin = eye_;
    ray.direction = normalized(across * view_.right + upwards * view_.up - view_.towards);
    return ray;
}

}  // namespace espalier::tools
