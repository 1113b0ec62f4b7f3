// A fixed list of questions to ask a blob: the same on every machine, because every float in it comes from integers by
// operations that round alike everywhere. Half of them are awkward on purpose: aimed at corners and at points of the
// surface, axis-parallel, from far away, or any bit pattern at all.
#pragma once

#include <bit>
#include <cstdint>
#include <iterator>
#include <span>

#include <espalier/espalier.hpp>

#include "answer_counts.hpp"
#include "numbers.hpp"

namespace espalier::platform {

class Questions : Numbers {
public:
    explicit Questions(const Blob& blob) : blob_(blob) {
        const Vec3 low = blob.bounds().min;
        const Vec3 high = blob.bounds().max;
        center_ = {(low.x + high.x) * 0.5f, (low.y + high.y) * 0.5f, (low.z + high.z) * 0.5f};
        half_ = {(high.x - low.x) * 0.5f, (high.y - low.y) * 0.5f, (high.z - low.z) * 0.5f};
        collect_corners();
    }

    Ray ray(std::uint32_t number) {
        Ray ray;
        const auto kind = number % 8;
        if (kind == 0) ray = towards({point_around(2.0f), point_around(1.0f)});
        else if (kind == 1) ray = {.origin = point_around(1.0f), .direction = axis()};
        else if (kind == 2) ray = towards({point_around(4096.0f), surface_point()});
        else if (kind == 3) ray = towards({surface_point(), point_around(1.0f)});
        else if (kind == 4) ray = towards({point_around(2.0f), corner()});
        else if (kind == 5) {
            ray = {.origin = corner(), .direction = axis()};
            step_back(ray);
        } else if (kind == 6) {
            ray = {.origin = any_bits(), .direction = any_bits()};
        } else {
            ray = towards({corner(), corner()});
            ray.t_min = fraction() * 0.25f;
            ray.t_max = 0.5f + fraction();
        }
        ray.culling = static_cast<FaceCulling>(word() % 3);
        return ray;
    }

    Sphere sphere(std::uint32_t number) {
        const auto kind = number % 4;
        if (kind == 0) return {point_around(1.0f), size() * 0.125f * fraction()};
        if (kind == 1) return {surface_point(), 0.0f};
        if (kind == 2) return {corner(), size() * 0.03125f * fraction()};
        return {any_bits(), any_float()};
    }

    Capsule capsule(std::uint32_t number) {
        const Sphere end = sphere(number);
        return {end.center, number % 3 == 0 ? end.center : point_around(1.0f), end.radius};
    }

    Box box(std::uint32_t number) {
        const Vec3 a = number % 4 == 3 ? any_bits() : number % 4 == 2 ? corner() : point_around(1.0f);
        const float away = size() * 0.25f * fraction();
        if (number % 5 == 0) return {a, a};
        return {a, {a.x + away, a.y + away, number % 3 == 0 ? infinity : a.z + away}};
    }

    LatticeBox box_in_steps(std::uint32_t number) {
        const LatticePoint low = steps(number);
        const std::int32_t away = static_cast<std::int32_t>(word() >> 16) & (number % 2 == 0 ? 0xFF : 0xFFFF);
        if (number % 4 == 3) return {low, steps(number)};
        const auto moved = [](std::int32_t from, std::int32_t by) {  // round and round
            return static_cast<std::int32_t>(static_cast<std::uint32_t>(from) + static_cast<std::uint32_t>(by));
        };
        return {low, {moved(low.x, away), moved(low.y, away / 2), moved(low.z, number % 3 == 0 ? 0 : away)}};
    }

    LatticeSegment segment_in_steps(std::uint32_t number) {
        const LatticePoint from = steps(number);
        LatticePoint to = steps(number / 4);
        if (number % 8 == 4) to = {from.x, from.y, to.z};
        return {from, to};
    }

    OrientedBox oriented_box(std::uint32_t number) {
        OrientedBox box = {number % 4 == 3 ? any_bits() : surface_point(), {}};
        for (Vec3& half : box.half_axes) half = difference(point_around(0.25f), center_);
        if (number % 3 == 0) box.half_axes[2] = {};  // flat
        if (number % 6 == 0) box.half_axes[1] = box.half_axes[0];
        return box;
    }

    Triangle corners(std::uint32_t number) {
        const Vec3 a = number % 4 == 3 ? any_bits() : corner(), b = point_around(1.0f);
        return {a, b, number % 3 == 0 ? corner() : number % 5 == 0 ? b : point_around(1.0f)};
    }

    /// As many as asked for, about a point.
    void planes(std::uint32_t number, std::span<Plane> planes) {
        const Vec3 on = number % 2 == 0 ? corner() : point_around(1.0f);
        for (Plane& plane : planes) {
            const Vec3 normal = number % 8 == 7 ? any_bits() : difference(point_around(1.0f), center_);
            const float beyond = number % 2 == 0 ? 0.0f : fraction() * size() * size() * 0.01f;
            plane = {normal, normal.x * on.x + normal.y * on.y + normal.z * on.z + beyond};
        }
    }

    Vec3 displacement(std::uint32_t number) {
        if (number % 3 == 0) return {};
        const Vec3 to = point_around(2.0f);
        return difference(to, center_);
    }

    Vec3 point(std::uint32_t number) {
        if (number % 4 == 3) return any_bits();
        return number % 4 == 1 ? surface_point() : point_around(number % 4 == 0 ? 1.0f : 1024.0f);
    }

    float distance(std::uint32_t number) {
        return number % 3 == 0 ? infinity : number % 3 == 1 ? size() * fraction() : any_float();
    }

    /// Of another blob, or of the same: near this one, or with a corner on a corner where both are one.
    Transform placement(std::uint32_t number, const Blob& other) {
        Transform placement;
        const float x = signed_fraction(), y = signed_fraction(), z = signed_fraction();
        if (number % 4 != 1) placement.rotation = {x, y, z, 1.0f};
        if (number % 8 == 4) placement.scale = 0.25f + fraction();
        const Vec3 low = other.bounds().min;
        const Vec3 high = other.bounds().max;
        const Vec3 middle = {(low.x + high.x) * 0.5f, (low.y + high.y) * 0.5f, (low.z + high.z) * 0.5f};
        const Vec3 from = turned(placement, number % 4 == 2 ? corner() : middle);
        const Vec3 to = number % 4 == 2 ? corner() : point_around(number % 4 == 3 ? 4.0f : 1.0f);
        placement.translation = {to.x - from.x, to.y - from.y, to.z - from.z};
        if (number % 16 == 7)
            placement = {{any_float(), any_float(), any_float(), any_float()}, any_bits(), any_float()};
        return placement;
    }

private:
    static constexpr std::uint32_t corner_capacity = 32;

    float any_float() { return std::bit_cast<float>(word()); }
    Vec3 any_bits() {
        const float x = any_float();
        const float y = any_float();
        return {x, y, any_float()};
    }

    [[nodiscard]] float size() const { return half_.x + half_.y + half_.z; }

    Vec3 point_around(float scale) {
        const float x = center_.x + half_.x * signed_fraction() * scale;
        const float y = center_.y + half_.y * signed_fraction() * scale;
        return {x, y, center_.z + half_.z * signed_fraction() * scale};
    }

    Vec3 surface_point() {
        const Vec3 near = point_around(1.0f);
        const ClosestPoint nearest = closest_point(blob_, near);
        return nearest ? nearest.point : near;
    }

    /// In the asset's box, at a corner, out to the ends of the range, or any bit pattern at all.
    LatticePoint steps(std::uint32_t number) {
        const Lattice lattice = blob_.lattice();
        if (number % 4 == 1)
            if (const Result<LatticePoint> place = to_lattice(lattice, corner())) return *place;
        const auto along = [&](int axis) {
            const auto any = static_cast<std::int32_t>(word());
            if (number % 8 == 7) return any;
            if (number % 8 == 3) return any >> 2;
            return static_cast<std::int32_t>(static_cast<std::uint32_t>(any) >> 8) % (lattice.extent[axis] + 1);
        };
        LatticePoint place;
        place.x = along(0);
        place.y = along(1);
        place.z = along(2);
        return place;
    }

    Vec3 corner() { return corner_count_ == 0 ? center_ : corners_[word() % corner_count_]; }

    Vec3 axis() {
        const std::uint32_t choice = word();
        const float length = (choice & 1u) != 0 ? 1.0f : -1.0f;
        const auto kind = (choice >> 8) % 3;
        if (kind == 0) return {length, 0.0f, 0.0f};
        if (kind == 1) return {-0.0f, length, 0.0f};
        return {0.0f, -0.0f, length};
    }

    static Vec3 difference(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

    /// Where a placement without its translation takes a point.
    static Vec3 turned(const Transform& placement, const Vec3& point) {
        const Quaternion& q = placement.rotation;
        const float scale = placement.scale / (q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
        const float x = point.x * scale;
        const float y = point.y * scale;
        const float z = point.z * scale;
        const float diagonal = q.w * q.w - q.x * q.x - q.y * q.y - q.z * q.z;
        const float along = 2.0f * (q.x * x + q.y * y + q.z * z);
        const float twice = 2.0f * q.w;
        return {diagonal * x + along * q.x + twice * (q.y * z - q.z * y),
                diagonal * y + along * q.y + twice * (q.z * x - q.x * z),
                diagonal * z + along * q.z + twice * (q.x * y - q.y * x)};
    }

    void step_back(Ray& ray) const {
        ray.origin.x -= ray.direction.x * size();
        ray.origin.y -= ray.direction.y * size();
        ray.origin.z -= ray.direction.z * size();
    }

    /// In braces, because the order in which a call's arguments draw their numbers is each compiler's own.
    static Ray towards(const Segment& segment) {
        const Vec3& from = segment.from;
        const Vec3& to = segment.to;
        return {.origin = from, .direction = {to.x - from.x, to.y - from.y, to.z - from.z}};
    }

    void collect_corners() {
        const std::uint32_t stride = blob_.triangle_count() / corner_capacity + 1;
        (void)for_each_triangle(blob_, [&](TriangleId triangle, const Triangle& corners) {
            if (triangle.index % stride == 0 && corner_count_ < corner_capacity) {
                corners_[corner_count_++] = corners.b;
            }
            return Visit::next;
        });
    }

    const Blob& blob_;
    Vec3 center_;
    Vec3 half_;
    Vec3 corners_[corner_capacity];
    std::uint32_t corner_count_ = 0;
};

/// Writes the vertices of a hull: the center of a box, and places along its axes with their coordinates turned.
inline void fill_vertices_around(const OrientedBox& box, Vec3 (&vertices)[12]) {
    for (std::size_t i = 0; i < std::size(vertices); ++i) {
        const Vec3& half = box.half_axes[i % 3];
        const float along = i < 3 ? 0.0f : i < 6 ? -1.0f : i < 9 ? 0.5f : 0.25f;
        const Vec3 from = i < 9 ? box.center : vertices[i - 3];
        vertices[i] = {from.x + along * half.y, from.y + along * half.z, from.z + along * half.x};
    }
}

/// Returns a function that asks `one` question after the other: blob, questions, their number, answers.
template <class One>
constexpr auto repeated(One) {
    return +[](const Blob& blob, Questions& questions, std::uint32_t count, Answers& answers) {
        for (std::uint32_t number = 0; number < count; ++number) One{}(blob, questions, number, answers);
    };
}

}  // namespace espalier::platform
