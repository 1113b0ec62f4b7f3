#include "sweep_maker.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "support/base/vectors.hpp"

namespace espalier::tests {

namespace {

Vec3 along_axis(std::uint32_t axis, float length) {
    return {axis == 0 ? length : 0.0f, axis == 1 ? length : 0.0f, axis == 2 ? length : 0.0f};
}

std::string in_hexadecimal(const char* name, std::span<const float> numbers, Vec3 displacement) {
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

std::vector<Vec3> SweepMaker::some_triangle() {
    Random& random = maker_.random();
    const GridTriangle& t = decoded_.triangles[random.below(static_cast<std::uint32_t>(decoded_.triangles.size()))];
    return {maker_.to_world(t.a), maker_.to_world(t.b), maker_.to_world(t.c)};
}

float SweepMaker::some_radius() {
    Random& random = maker_.random();
    const auto kind = random.below(6);
    if (kind == 0) return 0.0f;
    if (kind == 1) return step_ * static_cast<float>(1 + random.below(64));
    if (kind == 2) return size_ * 0.3f * random.unit();
    if (kind == 3) return step_ * 0.01f * random.unit();
    return size_ * 0.03f * random.unit();
}

SweepMaker::Path SweepMaker::random_path() {
    const Vec3 start = some_place();
    return {start, difference(some_place(), start)};
}

SweepMaker::Path SweepMaker::awkward_path(float radius) {
    Random& random = maker_.random();
    switch (random.below(8)) {
        case 0: {
            const Vec3 off = along_axis(random.below(3), random.coin() ? radius : -radius);
            const Vec3 way = along_axis(random.below(3), size_ * (random.unit() - 0.5f));
            return {difference(sum(some_vertex(), off), times(way, random.coin() ? 0.5f : 1.0f)), way};
        }
        case 1: {
            const Vec3 off = along_axis(random.below(3), random.coin() ? radius : -radius);
            return {sum(some_vertex(), off), random.in_cube(size_)};
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
            return {ray.origin, times(difference(target, ray.origin), random.coin() ? 1.0f : 2.0f)};
        }
        case 5:
            return {random.coin() ? some_vertex() : some_place(), {0.0f, 0.0f, 0.0f}};
        case 6: {
            const Vec3 start = some_vertex();
            return {start, difference(some_vertex(), start)};
        }
        default: {
            const Vec3 target = some_vertex();
            const Vec3 way = times(random.in_cube(size_), random.coin() ? 1.0f : 0.01f);
            return {difference(target, way), times(way, random.coin() ? 1.0f : 2.0f)};
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
    return {{path.start, sum(path.start, axis), size_ * 0.03f * maker_.random().unit()}, path.way};
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
            axis = difference(some_vertex(), some_vertex());
            break;
        case 3:
            axis = path.way;
            break;
        default:
            axis = random.in_cube(size_ * 0.1f);
    }
    const Vec3 from = random.coin() ? path.start : difference(path.start, axis);
    return {{from, sum(from, axis), radius}, path.way};
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
    return {{path.start, sum(path.start, {x, y, z})}, path.way};
}

Moving<Box> SweepMaker::awkward_box() {
    const float radius = some_radius();
    const Path path = awkward_path(radius);
    const Vec3 size = some_size(radius);
    const Vec3 low = maker_.random().coin() ? path.start : difference(path.start, size);
    return {{low, sum(low, size)}, path.way};
}

Moving<OrientedBox> SweepMaker::random_oriented_box() {
    const Path path = random_path();
    Random& random = maker_.random();
    const Vec3 x = random.in_cube(size_ * 0.04f);
    const Vec3 y = random.in_cube(size_ * 0.04f);
    return {{path.start, {x, y, random.in_cube(size_ * 0.04f)}}, path.way};
}

Moving<OrientedBox> SweepMaker::awkward_oriented_box() {
    Random& random = maker_.random();
    const float radius = some_radius();
    const Path path = awkward_path(radius);
    const Vec3 size = some_size(radius);
    OrientedBox box = {path.start, {along_axis(0, size.x), along_axis(1, size.y), along_axis(2, size.z)}};
    switch (random.below(4)) {
        case 0:
            break;
        case 1:  // turned about an axis
            box.half_axes[0] = {size.x * 0.6f, size.x * 0.8f, 0.0f};
            box.half_axes[1] = {size.y * -0.8f, size.y * 0.6f, 0.0f};
            break;
        case 2:  // parallel to a side
            box.half_axes[random.below(3)] = difference(some_vertex(), some_vertex());
            break;
        default:
            for (Vec3& half : box.half_axes) half = random.in_cube(size_ * 0.05f);
    }
    // A corner on the path, as often as the center.
    if (random.coin()) box.center = sum(sum(box.center, box.half_axes[0]), sum(box.half_axes[1], box.half_axes[2]));
    return {box, path.way};
}

Moving<OwnedHull> SweepMaker::random_hull() {
    const Path path = random_path();
    Random& random = maker_.random();
    OwnedHull hull;
    const std::uint32_t count = 4 + random.below(13);
    for (std::uint32_t i = 0; i < count; ++i) hull.vertices.push_back(sum(path.start, random.in_cube(size_ * 0.05f)));
    return {hull, path.way};
}

Moving<OwnedHull> SweepMaker::awkward_hull() {
    Random& random = maker_.random();
    const float radius = some_radius();
    const Path path = awkward_path(radius);
    OwnedHull hull;
    switch (random.below(6)) {
        case 0: {
            const std::vector<Vec3> corners = some_triangle();
            for (const Vec3& corner : corners) hull.vertices.push_back(sum(path.start, difference(corner, corners[0])));
            break;
        }
        case 1:  // a point, a segment
            hull.vertices.push_back(path.start);
            if (random.coin()) hull.vertices.push_back(sum(path.start, difference(some_vertex(), some_vertex())));
            break;
        case 2: {  // in one plane across an axis
            const std::uint32_t axis = random.below(3);
            for (int i = 0; i < 6; ++i) {
                Vec3 off = random.in_cube(radius);
                (axis == 0 ? off.x : axis == 1 ? off.y : off.z) = 0.0f;
                hull.vertices.push_back(sum(path.start, off));
            }
            break;
        }
        case 3: {  // corners of a box, each twice
            const Vec3 size = some_size(radius);
            for (unsigned i = 0; i < 16; ++i)
                hull.vertices.push_back(sum(path.start, {(i & 1u) != 0 ? size.x : 0.0f, (i & 2u) != 0 ? size.y : 0.0f,
                                                         (i & 4u) != 0 ? size.z : 0.0f}));
            break;
        }
        case 4:
            for (std::size_t i = 0; i < max_hull_vertices; ++i)
                hull.vertices.push_back(sum(path.start, random.in_cube(radius)));
            break;
        default: {
            const std::uint32_t count = 1 + random.below(9);
            hull.vertices.push_back(path.start);
            for (std::uint32_t i = 1; i < count; ++i)
                hull.vertices.push_back(sum(path.start, random.in_cube(size_ * 0.1f)));
        }
    }
    return {hull, path.way};
}

std::string describe(const Moving<Sphere>& m) {
    const float numbers[] = {m.shape.center.x, m.shape.center.y, m.shape.center.z, m.shape.radius};
    return in_hexadecimal("sphere", numbers, m.displacement);
}
std::string describe(const Moving<Capsule>& m) {
    const Capsule& c = m.shape;
    const float numbers[] = {c.from.x, c.from.y, c.from.z, c.to.x, c.to.y, c.to.z, c.radius};
    return in_hexadecimal("capsule", numbers, m.displacement);
}
std::string describe(const Moving<Box>& m) {
    const Box& b = m.shape;
    const float numbers[] = {b.min.x, b.min.y, b.min.z, b.max.x, b.max.y, b.max.z};
    return in_hexadecimal("box", numbers, m.displacement);
}
std::string describe(const Moving<OrientedBox>& m) {
    std::vector<float> numbers = {m.shape.center.x, m.shape.center.y, m.shape.center.z};
    for (const Vec3& half : m.shape.half_axes) numbers.insert(numbers.end(), {half.x, half.y, half.z});
    return in_hexadecimal("oriented box", numbers, m.displacement);
}
std::string describe(const Moving<OwnedHull>& m) {
    std::vector<float> numbers;
    for (const Vec3& vertex : m.shape.vertices) numbers.insert(numbers.end(), {vertex.x, vertex.y, vertex.z});
    return in_hexadecimal("hull", numbers, m.displacement);
}

}  // namespace espalier::tests
