#include "shape_maker.hpp"

#include <algorithm>
#include <cmath>

#include "support/base/vectors.hpp"

namespace espalier::tests {

namespace {

float& coordinate(Vec3& v, std::uint32_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

Vec3 unit(Vec3 a) {
    const double length = std::hypot(static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z));
    return {static_cast<float>(static_cast<double>(a.x) / length),
            static_cast<float>(static_cast<double>(a.y) / length),
            static_cast<float>(static_cast<double>(a.z) / length)};
}

}  // namespace

Vec3 ShapeMaker::point_around() {
    if (random_.coin()) {
        const Vec3 on = surface_point();
        return sum(on, times(direction(), length()));
    }
    return some_place();
}

Vec3 ShapeMaker::surface_point() {
    const GridTriangle& t = some_triangle();
    double v = static_cast<double>(random_.unit()), w = static_cast<double>(random_.unit());
    const std::uint32_t kind = random_.below(4);
    if (kind == 0) v = 0.5, w = 0.0;
    if (kind == 1) v = w = 0.25;
    if (v + w > 1.0) v = 1.0 - v, w = 1.0 - w;
    const auto at = [&](unsigned k) { return t.a[k] + v * (t.b[k] - t.a[k]) + w * (t.c[k] - t.a[k]); };
    return kind == 3 ? to_world(t.c) : to_world(at(0), at(1), at(2));
}

float ShapeMaker::length() { return std::ldexp(size_ * random_.unit(), -random_.between(0, 8)); }

float ShapeMaker::nudged(float value) {
    if (random_.below(3) != 0) return value;
    return std::nextafter(value, random_.coin() ? INFINITY : -INFINITY);
}
Vec3 ShapeMaker::nudged(Vec3 value) {
    const float x = nudged(value.x), y = nudged(value.y);
    return {x, y, nudged(value.z)};
}

Vec3 ShapeMaker::direction() {
    Vec3 d;
    do d = random_.in_cube(1.0f);
    while (dot(d, d) > 1.0f || dot(d, d) < 0.01f);
    return unit(d);
}

Capsule ShapeMaker::capsule(bool awkward) {
    if (!awkward) {
        const Vec3 from = point_around();
        return {from, sum(from, times(direction(), length())), length() * 0.25f};
    }
    Capsule capsule = {vertex(), vertex(), 0.0f};
    switch (random_.below(8)) {
        case 0:
            capsule.to = capsule.from;
            break;
        case 1:
            capsule = {surface_point(), surface_point(), 0.0f};
            break;
        case 2: {  // beside a triangle, as far away as the radius
            const Vec3 off = times(direction(), length());
            capsule.from = sum(vertex(), off);
            capsule.to = random_.coin() ? capsule.from : sum(capsule.from, cross(off, direction()));
            capsule.radius = nudged(std::sqrt(dot(off, off)));
            break;
        }
        case 3: {
            const float off = length();
            coordinate(capsule.from, 0) += off;
            coordinate(capsule.to, 0) += off;
            capsule.radius = nudged(off);
            break;
        }
        case 4: {  // from far away, nearly past it
            capsule.from = sum(capsule.from, times(direction(), size_ * 1e4f));
            capsule.radius = length() * 0.01f;
            break;
        }
        case 5:
            capsule.radius = random_.coin() ? INFINITY : size_ * 1e6f;
            break;
        default:
            capsule.radius = length() * 0.01f;
    }
    return capsule;
}

Box ShapeMaker::box(bool awkward) {
    if (!awkward) {
        const Vec3 min = point_around();
        const float x = length(), y = length();
        return {min, {min.x + x, min.y + y, min.z + length()}};
    }
    const Vec3 p = random_.coin() ? vertex() : surface_point(), q = random_.coin() ? vertex() : p;
    Box box = {{std::min(p.x, q.x), std::min(p.y, q.y), std::min(p.z, q.z)},
               {std::max(p.x, q.x), std::max(p.y, q.y), std::max(p.z, q.z)}};
    // One side moved far, so that it touches with what is left of the others.
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        const auto kind = random_.below(6);
        if (kind == 0) coordinate(box.max, axis) += length();
        else if (kind == 1) coordinate(box.min, axis) -= length();
        else if (kind == 2) {
            if (random_.coin()) coordinate(box.max, axis) = INFINITY;
            else coordinate(box.min, axis) = -1e30f;
        }
    }
    if (random_.below(16) == 0) std::swap(coordinate(box.min, 0), coordinate(box.max, 0));
    return {nudged(box.min), nudged(box.max)};
}

OrientedBox ShapeMaker::oriented_box(bool awkward) {
    const Vec3 x = direction(), y = unit(cross(x, direction())), z = cross(x, y);
    OrientedBox box = {point_around(), {times(x, length()), times(y, length()), times(z, length())}};
    if (!awkward) return box;
    const GridTriangle& t = some_triangle();
    const Vec3 a = to_world(t.a), ab = difference(to_world(t.b), a), ac = difference(to_world(t.c), a);
    switch (random_.below(8)) {
        case 0:  // upright on a triangle, or beside it by a little
            box.half_axes[0] = times(ab, 0.5f);
            box.half_axes[1] = times(ac, random_.coin() ? 0.5f : random_.unit());
            box.half_axes[2] = times(direction(), length());
            box.center = random_.coin() ? sum(a, box.half_axes[2]) : sum(sum(a, box.half_axes[0]), box.half_axes[2]);
            break;
        case 1:  // in its plane
            box.half_axes[0] = times(ab, random_.unit());
            box.half_axes[1] = times(ac, random_.unit());
            box.half_axes[2] = {};
            box.center = sum(a, times(random_.coin() ? ab : ac, random_.signed_unit() * 2.0f));
            break;
        case 2:  // a segment along a side, or through it
            box.half_axes[0] = random_.coin() ? ab : times(direction(), length());
            box.half_axes[1] = box.half_axes[2] = {};
            box.center = random_.coin() ? sum(a, times(ab, random_.signed_unit() * 2.5f)) : surface_point();
            break;
        case 3:  // a point, or three parallel half axes
            box.half_axes[0] = random_.coin() ? Vec3{} : ab;
            box.half_axes[1] = box.half_axes[2] = times(box.half_axes[0], 0.5f);
            box.center = surface_point();
            break;
        case 4:  // aligned with the axes: its faces on those of an ordinary box
            box.half_axes[0] = {length(), 0.0f, 0.0f};
            box.half_axes[1] = {0.0f, length(), 0.0f};
            box.half_axes[2] = {0.0f, 0.0f, random_.coin() ? 0.0f : length()};
            box.center = vertex();
            (random_.coin() ? box.center.x : box.center.y) += random_.coin() ? box.half_axes[0].x : box.half_axes[1].y;
            break;
        case 5:  // touching by a corner
            box.center = sum(vertex(), sum(box.half_axes[0], sum(box.half_axes[1], box.half_axes[2])));
            break;
        case 6: {
            const float far = random_.coin() ? 1e4f : 1e6f;
            box.center = sum(surface_point(), times(x, size_ * far));
            box.half_axes[0] = times(x, nudged(size_ * far));
            break;
        }
        default:
            box.half_axes[random_.below(3)] = times(direction(), size_ * 1e3f);
    }
    box.center = nudged(box.center);
    return box;
}

Triangle ShapeMaker::corners(bool awkward) {
    const Vec3 near = point_around();
    const float far = length();
    const Vec3 p = times(direction(), far), q = times(direction(), far);
    if (!awkward) return {near, sum(near, p), sum(near, q)};
    const GridTriangle& t = some_triangle();
    Triangle corners = {to_world(t.a), to_world(t.b), to_world(t.c)};
    switch (random_.below(8)) {
        case 0:
            break;
        case 1:  // over a side
            corners.c = sum(corners.c, p);
            break;
        case 2:
            corners.b = sum(corners.a, p);
            corners.c = sum(corners.a, q);
            break;
        case 3: {  // in its plane
            const Vec3 along = times(difference(corners.b, corners.a), random_.signed_unit() * 2.0f);
            corners = {sum(corners.a, along), sum(corners.b, along), sum(corners.c, along)};
            break;
        }
        case 4:
            corners = {surface_point(), surface_point(), surface_point()};
            break;
        case 5:
            corners.a = surface_point();
            corners.b = corners.a;
            corners.c = random_.coin() ? corners.a : sum(corners.a, p);
            break;
        case 6:
            corners.a = sum(corners.a, times(direction(), size_ * 1e5f));
            break;
        default:
            corners = {surface_point(), sum(vertex(), times(p, 1e4f)), sum(vertex(), times(q, 1e4f))};
    }
    return {nudged(corners.a), nudged(corners.b), nudged(corners.c)};
}

ConvexVolume ShapeMaker::planes(bool awkward) {
    std::vector<Plane>& planes = planes_;
    planes.clear();
    const auto add = [&](Vec3 normal, Vec3 on, float beyond) {
        if (is_zero(normal)) normal.z = 1.0f;
        planes.push_back({normal, dot(normal, on) + beyond});
    };
    const Vec3 center = awkward ? surface_point() : point_around();
    if (!awkward && random_.coin()) {  // a frustum
        const Vec3 x = direction(), y = unit(cross(x, direction())), z = cross(x, y);
        const float width = random_.unit();
        for (const Vec3 side : {y, z, times(y, -1.0f), times(z, -1.0f)})
            add(difference(side, times(x, width)), center, 0.0f);
        add(times(x, -1.0f), center, -0.01f * size_);
        add(x, center, length());
        return {planes};
    }
    const std::uint32_t kind = awkward ? random_.below(6) : 6;
    switch (kind) {
        case 0: {  // a slab without thickness, along an axis or along a triangle
            const GridTriangle& t = some_triangle();
            const Vec3 a = to_world(t.a);
            Vec3 normal = cross(difference(to_world(t.b), a), difference(to_world(t.c), a));
            if (random_.coin()) {
                normal = {};
                coordinate(normal, random_.below(3)) = 1.0f;
            }
            add(normal, a, 0.0f);
            add(times(normal, -1.0f), a, 0.0f);
            if (random_.coin()) add(direction(), surface_point(), 0.0f);
            break;
        }
        case 1: {  // a cone that touches with its apex
            const std::uint32_t count = 3 + random_.below(30);
            const Vec3 axis = direction();
            for (std::uint32_t i = 0; i < count; ++i) add(sum(axis, times(direction(), 0.9f)), center, 0.0f);
            break;
        }
        case 2:  // one plane
            add(direction(), center, 0.0f);
            break;
        case 3:  // a cell of an axis-aligned grid, with offsets that are exact
            for (std::uint32_t axis = 0; axis < 3; ++axis) {
                Vec3 p = vertex();
                Vec3 normal;
                coordinate(normal, axis) = random_.coin() ? 1.0f : -1.0f;
                add(normal, p, 0.0f);
            }
            break;
        case 4:
            if (random_.coin()) planes.push_back({direction(), random_.coin() ? INFINITY : 1e30f});
            if (random_.below(8) == 0) planes.push_back({direction(), -INFINITY});
            add(times(direction(), 1e-30f), center, 0.0f);
            add(times(direction(), 1e30f), center, 0.0f);
            break;
        default: {  // a k-DOP
            const std::uint32_t half = random_.coin() ? 13 : 3 + random_.below(10);
            const float radius = length();
            for (std::uint32_t i = 0; i < half; ++i) {
                Vec3 normal;
                const std::uint32_t code = i + 14;  // digits of base 3, of which the first that is not 1 is 2
                normal = {static_cast<float>(code / 9) - 1.0f, static_cast<float>(code / 3 % 3) - 1.0f,
                          static_cast<float>(code % 3) - 1.0f};
                add(normal, center, radius * std::sqrt(dot(normal, normal)));
                add(times(normal, -1.0f), center, awkward ? 0.0f : radius);
            }
        }
    }
    for (Plane& plane : planes) plane.offset = awkward ? nudged(plane.offset) : plane.offset;
    return {planes};
}

std::string describe(const ConvexVolume& volume) {
    std::string text = "planes ";
    for (const Plane& plane : volume.planes) text += describe(plane) + ", ";
    return text;
}

}  // namespace espalier::tests
