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

RayHit hit_of(const Blob& blob, const Ray& ray) { return raycast(blob, ray); }
RayHit hit_of(const BakedScene& scene, const Ray& ray) { return *raycast(scene, ray); }

float step_of(const Blob& blob) { return std::ldexp(1.0f, blob.lattice().step_exponent); }
float step_of(const BakedScene& scene) { return detail::data_of(scene).coarsest_step; }

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

/// A subject that is a blob or a scene.
template <class Surface>
class SubjectOf final : public Subject {
public:
    explicit SubjectOf(const Surface& surface) : surface_(surface) {}

    [[nodiscard]] RayHit closest_hit(const Ray& ray) const override { return hit_of(surface_, ray); }
    [[nodiscard]] bool is_hit(const Ray& ray) const override { return occluded(surface_, ray).yes(); }
    [[nodiscard]] Box bounds() const override { return surface_.bounds(); }
    [[nodiscard]] float step() const override { return step_of(surface_); }
    void for_each_corner(const std::function<void(Vec3)>& visit) const override { visit_corners(surface_, visit); }

private:
    const Surface& surface_;
};

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

std::unique_ptr<Subject> subject_of(const Blob& blob) { return std::make_unique<SubjectOf<Blob>>(blob); }
std::unique_ptr<Subject> subject_of(const BakedScene& scene) { return std::make_unique<SubjectOf<BakedScene>>(scene); }

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
