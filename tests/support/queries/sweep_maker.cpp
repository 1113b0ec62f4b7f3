#include "sweep_maker.hpp"

#include <algorithm>
#include <cmath>

#include "support/base/vectors.hpp"

namespace espalier::tests {

namespace {

Vec3 along_axis(std::uint32_t axis, float length) {
    return {axis == 0 ? length : 0.0f, axis == 1 ? length : 0.0f, axis == 2 ? length : 0.0f};
}

}  // namespace

float SweepMaker::step() const { return std::ldexp(1.0f, decoded_.step_exponent); }

float SweepMaker::some_radius() {
    const auto kind = random_.below(6);
    if (kind == 0) return 0.0f;
    if (kind == 1) return step() * static_cast<float>(1 + random_.below(64));
    if (kind == 2) return size_ * 0.3f * random_.unit();
    if (kind == 3) return step() * 0.01f * random_.unit();
    return size_ * 0.03f * random_.unit();
}

SweepMaker::Path SweepMaker::random_path() {
    const Vec3 start = some_place();
    return {start, difference(some_place(), start)};
}

SweepMaker::Path SweepMaker::awkward_path(float radius) {
    switch (random_.below(8)) {
        case 0: {
            const Vec3 off = along_axis(random_.below(3), random_.coin() ? radius : -radius);
            const Vec3 way = along_axis(random_.below(3), size_ * (random_.unit() - 0.5f));
            return {difference(sum(vertex(), off), times(way, random_.coin() ? 0.5f : 1.0f)), way};
        }
        case 1: {
            const Vec3 off = along_axis(random_.below(3), random_.coin() ? radius : -radius);
            return {sum(vertex(), off), random_.in_cube(size_)};
        }
        case 2: {
            const Ray along = ray(RayKind::in_plane);
            return {along.origin, times(along.direction, random_.coin() ? 1.0f : 4.0f)};
        }
        case 3: {
            const Ray along = ray(RayKind::from_face);
            return {along.origin, along.direction};
        }
        case 4: {
            const Ray along = ray(RayKind::far_ten_thousand);
            const Vec3 target = vertex();
            return {along.origin, times(difference(target, along.origin), random_.coin() ? 1.0f : 2.0f)};
        }
        case 5:
            return {random_.coin() ? vertex() : some_place(), {0.0f, 0.0f, 0.0f}};
        case 6: {
            const Vec3 start = vertex();
            return {start, difference(vertex(), start)};
        }
        default: {
            const Vec3 target = vertex();
            const Vec3 way = times(random_.in_cube(size_), random_.coin() ? 1.0f : 0.01f);
            return {difference(target, way), times(way, random_.coin() ? 1.0f : 2.0f)};
        }
    }
}

Moving<Sphere> SweepMaker::sphere(bool awkward) {
    if (!awkward) {
        const Path path = random_path();
        return {{path.start, size_ * 0.03f * random_.unit()}, path.way};
    }
    const float radius = some_radius();
    const Path path = awkward_path(radius);
    return {{path.start, radius}, path.way};
}

Moving<Capsule> SweepMaker::capsule(bool awkward) {
    if (!awkward) {
        const Path path = random_path();
        const Vec3 axis = random_.in_cube(size_ * 0.05f);
        return {{path.start, sum(path.start, axis), size_ * 0.03f * random_.unit()}, path.way};
    }
    const float radius = some_radius();
    const Path path = awkward_path(radius);
    Vec3 axis = {0.0f, 0.0f, 0.0f};
    switch (random_.below(5)) {
        case 0:
            break;
        case 1:
            axis = along_axis(random_.below(3), random_.coin() ? radius * 4.0f : size_ * 0.1f);
            break;
        case 2:
            axis = difference(vertex(), vertex());
            break;
        case 3:
            axis = path.way;
            break;
        default:
            axis = random_.in_cube(size_ * 0.1f);
    }
    const Vec3 from = random_.coin() ? path.start : difference(path.start, axis);
    return {{from, sum(from, axis), radius}, path.way};
}

Vec3 SweepMaker::some_size(float radius) {
    const auto side = [&] {
        return random_.below(4) == 0 ? 0.0f : random_.coin() ? radius : size_ * 0.05f * random_.unit();
    };
    const float x = side();
    const float y = side();
    return {x, y, side()};
}

Moving<Box> SweepMaker::box(bool awkward) {
    if (!awkward) {
        const Path path = random_path();
        const float x = size_ * 0.05f * random_.unit();
        const float y = size_ * 0.05f * random_.unit();
        const float z = size_ * 0.05f * random_.unit();
        return {{path.start, sum(path.start, {x, y, z})}, path.way};
    }
    const float radius = some_radius();
    const Path path = awkward_path(radius);
    const Vec3 size = some_size(radius);
    const Vec3 low = random_.coin() ? path.start : difference(path.start, size);
    return {{low, sum(low, size)}, path.way};
}

Moving<OrientedBox> SweepMaker::oriented_box(bool awkward) {
    if (!awkward) {
        const Path path = random_path();
        const Vec3 x = random_.in_cube(size_ * 0.04f);
        const Vec3 y = random_.in_cube(size_ * 0.04f);
        return {{path.start, {x, y, random_.in_cube(size_ * 0.04f)}}, path.way};
    }
    const float radius = some_radius();
    const Path path = awkward_path(radius);
    const Vec3 size = some_size(radius);
    OrientedBox box = {path.start, {along_axis(0, size.x), along_axis(1, size.y), along_axis(2, size.z)}};
    switch (random_.below(4)) {
        case 0:
            break;
        case 1:  // turned about an axis
            box.half_axes[0] = {size.x * 0.6f, size.x * 0.8f, 0.0f};
            box.half_axes[1] = {size.y * -0.8f, size.y * 0.6f, 0.0f};
            break;
        case 2:  // parallel to a side
            box.half_axes[random_.below(3)] = difference(vertex(), vertex());
            break;
        default:
            for (Vec3& half : box.half_axes) half = random_.in_cube(size_ * 0.05f);
    }
    // A corner on the path, as often as the center.
    if (random_.coin()) box.center = sum(sum(box.center, box.half_axes[0]), sum(box.half_axes[1], box.half_axes[2]));
    return {box, path.way};
}

Moving<OwnedHull> SweepMaker::hull(bool awkward) {
    if (!awkward) {
        const Path path = random_path();
        OwnedHull hull;
        const std::uint32_t count = 4 + random_.below(13);
        for (std::uint32_t i = 0; i < count; ++i)
            hull.vertices.push_back(sum(path.start, random_.in_cube(size_ * 0.05f)));
        return {hull, path.way};
    }
    const float radius = some_radius();
    const Path path = awkward_path(radius);
    OwnedHull hull;
    switch (random_.below(6)) {
        case 0: {
            const GridTriangle& t = some_triangle();
            for (const GridPoint& corner : {t.a, t.b, t.c})
                hull.vertices.push_back(sum(path.start, difference(to_world(corner), to_world(t.a))));
            break;
        }
        case 1:  // a point, a segment
            hull.vertices.push_back(path.start);
            if (random_.coin()) hull.vertices.push_back(sum(path.start, difference(vertex(), vertex())));
            break;
        case 2: {  // in one plane across an axis
            const std::uint32_t axis = random_.below(3);
            for (int i = 0; i < 6; ++i) {
                Vec3 off = random_.in_cube(radius);
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
                hull.vertices.push_back(sum(path.start, random_.in_cube(radius)));
            break;
        default: {
            const std::uint32_t count = 1 + random_.below(9);
            hull.vertices.push_back(path.start);
            for (std::uint32_t i = 1; i < count; ++i)
                hull.vertices.push_back(sum(path.start, random_.in_cube(size_ * 0.1f)));
        }
    }
    return {hull, path.way};
}

std::string describe(const OwnedHull& hull) {
    std::string text = "hull ";
    for (const Vec3& vertex : hull.vertices) text += describe(vertex);
    return text;
}

}  // namespace espalier::tests
