#include "sweep_maker.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>

namespace espalier::tests {

namespace {

Vec3 plus(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 minus(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 times(Vec3 a, float by) { return {a.x * by, a.y * by, a.z * by}; }
Vec3 along_axis(std::uint32_t axis, float length) {
    return {axis == 0 ? length : 0.0f, axis == 1 ? length : 0.0f, axis == 2 ? length : 0.0f};
}

std::string in_hexadecimal(const char* name, std::initializer_list<float> numbers, Vec3 displacement) {
    std::string text = name;
    const auto append = [&](float number) {
        char digits[40];
        std::snprintf(digits, sizeof digits, " %a", static_cast<double>(number));
        text += digits;
    };
    for (const float number : numbers) append(number);
    text += " by";
    for (const float number : {displacement.x, displacement.y, displacement.z}) append(number);
    return text;
}

}  // namespace

SweepMaker::SweepMaker(const DecodedBlob& decoded, std::uint64_t seed)
    : decoded_(decoded),
      maker_(decoded, seed),
      step_(std::ldexp(1.0f, decoded.step_exponent)),
      size_(step_ * static_cast<float>(*std::max_element(decoded.extent.begin(), decoded.extent.end()))) {}

Vec3 SweepMaker::some_place() {
    Random& random = maker_.random();
    GridPoint at;
    for (unsigned k = 0; k < 3; ++k) {
        const auto extent = static_cast<float>(decoded_.extent[k]);
        at[k] = static_cast<std::int32_t>(extent * (random.unit() * 1.5f - 0.25f));
    }
    return maker_.to_world(at);
}

Vec3 SweepMaker::some_vertex() {
    Random& random = maker_.random();
    const GridTriangle& t = decoded_.triangles[random.below(static_cast<std::uint32_t>(decoded_.triangles.size()))];
    const std::uint32_t corner = random.below(3);
    return maker_.to_world(corner == 0 ? t.a : corner == 1 ? t.b : t.c);
}

float SweepMaker::some_radius() {
    Random& random = maker_.random();
    switch (random.below(6)) {
        case 0:
            return 0.0f;
        case 1:
            return step_ * static_cast<float>(1 + random.below(64));
        case 2:
            return size_ * 0.3f * random.unit();
        case 3:
            return step_ * 0.01f * random.unit();
        default:
            return size_ * 0.03f * random.unit();
    }
}

SweepMaker::Path SweepMaker::random_path() {
    const Vec3 start = some_place();
    return {start, minus(some_place(), start)};
}

SweepMaker::Path SweepMaker::awkward_path(float radius) {
    Random& random = maker_.random();
    switch (random.below(8)) {
        case 0: {
            const Vec3 off = along_axis(random.below(3), random.coin() ? radius : -radius);
            const Vec3 way = along_axis(random.below(3), size_ * (random.unit() - 0.5f));
            return {minus(plus(some_vertex(), off), times(way, random.coin() ? 0.5f : 1.0f)), way};
        }
        case 1: {
            const Vec3 off = along_axis(random.below(3), random.coin() ? radius : -radius);
            return {plus(some_vertex(), off), random.in_cube(size_)};
        }
        case 2: {
            const Ray ray = maker_.ray(RayKind::in_plane);
            return {ray.origin, times(ray.direction, random.coin() ? 1.0f : 4.0f)};
        }
        case 3: {
            const Ray ray = maker_.ray(RayKind::from_face);
            return {ray.origin, ray.direction};
        }
        case 4: {
            const Ray ray = maker_.ray(RayKind::far_ten_thousand);
            const Vec3 target = some_vertex();
            return {ray.origin, times(minus(target, ray.origin), random.coin() ? 1.0f : 2.0f)};
        }
        case 5:
            return {random.coin() ? some_vertex() : some_place(), {0.0f, 0.0f, 0.0f}};
        case 6: {
            const Vec3 start = some_vertex();
            return {start, minus(some_vertex(), start)};
        }
        default: {
            const Vec3 target = some_vertex();
            const Vec3 way = times(random.in_cube(size_), random.coin() ? 1.0f : 0.01f);
            return {minus(target, way), times(way, random.coin() ? 1.0f : 2.0f)};
        }
    }
}

Moving<Sphere> SweepMaker::random_sphere() {
    const Path path = random_path();
    return {{path.start, size_ * 0.03f * maker_.random().unit()}, path.way};
}

Moving<Sphere> SweepMaker::awkward_sphere() {
    const float radius = some_radius();
    const Path path = awkward_path(radius);
    return {{path.start, radius}, path.way};
}

Moving<Capsule> SweepMaker::random_capsule() {
    const Path path = random_path();
    const Vec3 axis = maker_.random().in_cube(size_ * 0.05f);
    return {{path.start, plus(path.start, axis), size_ * 0.03f * maker_.random().unit()}, path.way};
}

Moving<Capsule> SweepMaker::awkward_capsule() {
    Random& random = maker_.random();
    const float radius = some_radius();
    const Path path = awkward_path(radius);
    Vec3 axis = {0.0f, 0.0f, 0.0f};
    switch (random.below(5)) {
        case 0:
            break;
        case 1:
            axis = along_axis(random.below(3), random.coin() ? radius * 4.0f : size_ * 0.1f);
            break;
        case 2:
            axis = minus(some_vertex(), some_vertex());
            break;
        case 3:
            axis = path.way;
            break;
        default:
            axis = random.in_cube(size_ * 0.1f);
    }
    const Vec3 from = random.coin() ? path.start : minus(path.start, axis);
    return {{from, plus(from, axis), radius}, path.way};
}

Vec3 SweepMaker::some_size(float radius) {
    Random& random = maker_.random();
    const auto side = [&] {
        return random.below(4) == 0 ? 0.0f : random.coin() ? radius : size_ * 0.05f * random.unit();
    };
    const float x = side();
    const float y = side();
    return {x, y, side()};
}

Moving<Box> SweepMaker::random_box() {
    const Path path = random_path();
    Random& random = maker_.random();
    const float x = size_ * 0.05f * random.unit();
    const float y = size_ * 0.05f * random.unit();
    const float z = size_ * 0.05f * random.unit();
    return {{path.start, plus(path.start, {x, y, z})}, path.way};
}

Moving<Box> SweepMaker::awkward_box() {
    const float radius = some_radius();
    const Path path = awkward_path(radius);
    const Vec3 size = some_size(radius);
    const Vec3 low = maker_.random().coin() ? path.start : minus(path.start, size);
    return {{low, plus(low, size)}, path.way};
}

std::string describe(const Moving<Sphere>& m) {
    return in_hexadecimal("sphere", {m.shape.center.x, m.shape.center.y, m.shape.center.z, m.shape.radius},
                          m.displacement);
}
std::string describe(const Moving<Capsule>& m) {
    const Capsule& c = m.shape;
    return in_hexadecimal("capsule", {c.from.x, c.from.y, c.from.z, c.to.x, c.to.y, c.to.z, c.radius}, m.displacement);
}
std::string describe(const Moving<Box>& m) {
    const Box& b = m.shape;
    return in_hexadecimal("box", {b.min.x, b.min.y, b.min.z, b.max.x, b.max.y, b.max.z}, m.displacement);
}

}  // namespace espalier::tests
