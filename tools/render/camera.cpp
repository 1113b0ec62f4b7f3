#include "camera.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include <espalier/transform.hpp>
#include <espalier/walk.hpp>

namespace espalier::tools {

namespace {

/// Visits the corners of all triangles.
void visit_corners(const Blob& blob, const std::function<void(Vec3)>& visit) {
    static_cast<void>(for_each_triangle(blob, [&](TriangleId, const Triangle& corners) {
        for (const Vec3& corner : {corners.a, corners.b, corners.c}) visit(corner);
        return Visit::next;
    }));
}

/// Visits the corners of the boxes of all instances.
void visit_corners(const BakedScene& scene, const std::function<void(Vec3)>& visit) {
    for (std::uint32_t i = 0; i < scene.instance_count(); ++i) {
        const Instance instance = *instance_at(scene, {i});
        const Result<Blob> mesh = mesh_at(scene, {i});
        if (mesh && mesh->triangle_count() == 0) continue;
        const Box bounds = mesh ? mesh->bounds() : scene.tiles()[instance.mesh - scene.meshes().size()].bounds();
        const Vec3 low = bounds.min;
        const Vec3 high = bounds.max;
        for (unsigned corner = 0; corner < 8; ++corner) {
            const Vec3 point{(corner & 1u) != 0 ? high.x : low.x, (corner & 2u) != 0 ? high.y : low.y,
                             (corner & 4u) != 0 ? high.z : low.z};
            visit(to_world(instance.transform, point));
        }
    }
}

constexpr double field_of_view = 32.0;  // degrees, of the shorter side
constexpr float margin = 1.12f;

float radians(double degrees) { return static_cast<float>(degrees * std::numbers::pi / 180.0); }

/// From axes in which +Y is up to axes in which `up` is.
Vec3 turned(Vec3 a, Axis up) {
    if (up == Axis::z) return {a.x, -a.z, a.y};
    if (up == Axis::x) return {a.y, -a.x, a.z};
    return a;
}

/// The nearest place of the eye in one plane: a point at (side, depth) is in the picture when it lies between the two
/// lines that leave the eye at `slope` to the left and the right.
class Fit {
public:
    explicit Fit(float slope) : slope_(slope) {}
    void include(float side, float depth) {
        right_ = std::max(right_, depth + side / slope_);
        left_ = std::max(left_, depth - side / slope_);
    }
    [[nodiscard]] float distance() const { return std::isfinite(right_) ? 0.5f * (right_ + left_) : 1.0f; }
    [[nodiscard]] float sideways() const { return std::isfinite(right_) ? 0.5f * slope_ * (right_ - left_) : 0.0f; }

private:
    float slope_;
    float right_ = -std::numeric_limits<float>::infinity();
    float left_ = -std::numeric_limits<float>::infinity();
};

}  // namespace

RayHit Subject::closest_hit(const Ray& ray) const {
    return file_.is_a_scene ? *raycast(file_.scene(), ray) : raycast(file_.blob, ray);
}

bool Subject::is_hit(const Ray& ray) const {
    return (file_.is_a_scene ? occluded(file_.scene(), ray) : occluded(file_.blob, ray)).yes();
}

float Subject::step() const {
    return file_.is_a_scene ? detail::data_of(file_.scene()).coarsest_step
                            : std::ldexp(1.0f, file_.blob.lattice().step_exponent);
}

void Subject::for_each_corner(const std::function<void(Vec3)>& visit) const {
    if (file_.is_a_scene) visit_corners(file_.scene(), visit);
    else visit_corners(file_.blob, visit);
}

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

Camera::Camera(const Subject& subject, const View& view, unsigned width, unsigned height)
    : view_(view), width_(static_cast<float>(width)), height_(static_cast<float>(height)) {
    const float half = std::tan(0.5f * radians(field_of_view));
    const float shorter = std::min(width_, height_);
    half_width_ = half * width_ / shorter;
    half_height_ = half * height_ / shorter;
    Fit across(half_width_ / margin);
    Fit upwards(half_height_ / margin);
    const Box bounds = subject.bounds();
    const Vec3 middle = 0.5f * (bounds.min + bounds.max);
    subject.for_each_corner([&](Vec3 corner) {
        const Vec3 offset = corner - middle;
        across.include(dot(offset, view_.right), dot(offset, view_.towards));
        upwards.include(dot(offset, view_.up), dot(offset, view_.towards));
    });
    const float distance = std::max(across.distance(), upwards.distance());
    eye_ = middle + across.sideways() * view_.right + upwards.sideways() * view_.up + distance * view_.towards;
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
