#include "shading.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <thread>

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
Vec3 turned_up(Vec3 a, Axis up) {
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

std::uint8_t encoded(float light) {
    const float value = std::clamp(light, 0.0f, 1.0f);
    const float curved = value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1.0f / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(std::lround(255.0f * curved));
}

constexpr Colour surface_colour{0.62f, 0.60f, 0.56f};
constexpr Colour sky{0.30f, 0.34f, 0.40f};
constexpr Colour ground{0.16f, 0.14f, 0.12f};
constexpr Colour main_colour{1.00f, 0.96f, 0.88f};
constexpr Colour side_colour{0.20f, 0.26f, 0.36f};

Colour filtered(Colour light, Colour by) { return {light.red * by.red, light.green * by.green, light.blue * by.blue}; }

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
    return {turned_up(right, up), turned_up(cross(towards, right), up), turned_up(towards, up)};
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

Colour operator+(Colour a, Colour b) { return {a.red + b.red, a.green + b.green, a.blue + b.blue}; }
Colour operator*(float factor, Colour colour) {
    return {factor * colour.red, factor * colour.green, factor * colour.blue};
}
Colour mix(Colour a, Colour b, float share_of_b) { return (1.0f - share_of_b) * a + share_of_b * b; }

Image::Image(unsigned width, unsigned height)
    : width_(width), height_(height), pixels_(std::size_t{3} * width * height) {}

void Image::set(unsigned column, unsigned row, Colour colour) {
    std::uint8_t* pixel = pixels_.data() + std::size_t{3} * (std::size_t{row} * width_ + column);
    pixel[0] = encoded(colour.red);
    pixel[1] = encoded(colour.green);
    pixel[2] = encoded(colour.blue);
}

void for_each_row(unsigned rows, unsigned threads, const std::function<void(unsigned)>& row,
                  const std::function<void(double)>& done) {
    if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
    threads = std::clamp(threads, 1u, std::max(1u, rows));
    std::atomic<unsigned> next{0};
    std::vector<std::jthread> helpers;
    for (unsigned i = 1; i < threads; ++i) {
        helpers.emplace_back([&] {
            for (unsigned number = next++; number < rows; number = next++) row(number);
        });
    }
    for (unsigned number = next++; number < rows; number = next++) {
        row(number);
        done(static_cast<double>(number) / rows);
    }
}

Shading::Shading(const Subject& subject, const View& view, Vec3 world_up)
    : subject_(subject),
      world_up_(world_up),
      main_light_(normalized(-0.55f * view.right + 0.75f * view.up + 0.60f * view.towards)),
      side_light_(normalized(0.90f * view.right + 0.10f * view.up + 0.35f * view.towards)) {
    // Off the surface by more than its own rounding: the hit point is a float, and the vertices are snapped.
    const Box bounds = subject.bounds();
    const Vec3 low = bounds.min;
    const Vec3 high = bounds.max;
    const float farthest = std::max(
        {std::abs(low.x), std::abs(low.y), std::abs(low.z), std::abs(high.x), std::abs(high.y), std::abs(high.z)});
    const Vec3 diagonal = high - low;
    const float extent = std::max({diagonal.x, diagonal.y, diagonal.z});
    shadow_offset_ = 2.0f * subject.step() + 1e-6f * farthest + 1e-4f * extent;
}

Colour Shading::background(float height) { return mix({0.10f, 0.11f, 0.13f}, {0.42f, 0.48f, 0.55f}, height); }

bool Shading::in_shadow(Vec3 point, Vec3 normal) const {
    Ray ray;
    ray.origin = point + shadow_offset_ * normal;
    ray.direction = main_light_;
    return subject_.is_hit(ray);
}

Colour Shading::colour(const Ray& ray, float height) const {
    const RayHit hit = subject_.closest_hit(ray);
    if (!hit) return background(height);
    const Vec3 normal = hit.side == Side::front ? hit.normal : -1.0f * hit.normal;
    Colour light = mix(ground, sky, 0.5f + 0.5f * dot(normal, world_up_));
    light = light + std::max(0.0f, dot(normal, side_light_)) * side_colour;
    const float facing = dot(normal, main_light_);
    if (facing > 0.0f && !in_shadow(ray.origin + hit.t * ray.direction, normal)) light = light + facing * main_colour;
    return filtered(light, surface_colour);
}

Colour heat_colour(float heat) {
    constexpr Colour stops[] = {{0.00f, 0.00f, 0.01f}, {0.02f, 0.03f, 0.30f}, {0.25f, 0.02f, 0.30f},
                                {0.75f, 0.10f, 0.05f}, {0.95f, 0.55f, 0.05f}, {1.00f, 1.00f, 0.95f}};
    constexpr int last = static_cast<int>(std::size(stops)) - 1;
    const float place = std::clamp(heat, 0.0f, 1.0f) * static_cast<float>(last);
    const int stop = std::min(static_cast<int>(place), last - 1);
    return mix(stops[stop], stops[stop + 1], place - static_cast<float>(stop));
}

}  // namespace espalier::tools
