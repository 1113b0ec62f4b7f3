#include "shading.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <thread>

namespace espalier::tools {

namespace {

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
