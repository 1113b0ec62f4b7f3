// Makes shapes near a box from the same random numbers on every machine.
#pragma once

#include <espalier/ray.hpp>
#include <espalier/shapes.hpp>
#include <espalier/types.hpp>

#include "../platform/numbers.hpp"

namespace espalier::firmware {

/// A convex hull of six vertices around a point.
class Octahedron {
public:
    Octahedron(const Vec3& at, float radius)
        : vertices_{{at.x - radius, at.y, at.z}, {at.x + radius, at.y, at.z}, {at.x, at.y - radius, at.z},
                    {at.x, at.y + radius, at.z}, {at.x, at.y, at.z - radius}, {at.x, at.y, at.z + radius}} {}
    [[nodiscard]] ConvexHull hull() const { return {vertices_}; }

private:
    Vec3 vertices_[6];
};

/// Shapes near a box, in the order in which they are asked for.
class QuestionMaker : platform::Numbers {
public:
    explicit QuestionMaker(const Box& box) : low_(box.min), size_(difference(box.max, box.min)) {
        center_ = {low_.x + 0.5f * size_.x, low_.y + 0.5f * size_.y, low_.z + 0.5f * size_.z};
        const float largest = size_.x > size_.y ? size_.x : size_.y;
        extent_ = largest > size_.z ? largest : size_.z;
    }

    static Vec3 difference(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    [[nodiscard]] const Vec3& size() const { return size_; }
    [[nodiscard]] const Vec3& center() const { return center_; }
    /// Returns the longest side of the box.
    [[nodiscard]] float extent() const { return extent_; }

    Vec3 point_in_box() {
        const float x = fraction();
        const float y = fraction();
        return {low_.x + size_.x * x, low_.y + size_.y * y, low_.z + size_.z * fraction()};
    }

    /// Uniform on the unit sphere, without a square root: stereographic, with as many points thrown away as it
    /// stretches.
    Vec3 unit_vector() {
        for (;;) {
            const float a = symmetric();
            const float b = symmetric();
            const float squared = a * a + b * b;
            const float scale = 1.0f / (1.0f + squared);
            if (squared > 1.0f || fraction() > scale * scale) continue;
            const float z = (1.0f - squared) * scale;
            return {2.0f * a * scale, 2.0f * b * scale, (word() & 1u) != 0 ? z : -z};
        }
    }

    /// Incoherent, as in bench/base.hpp: from a sphere around the box of 1.2 times its radius towards points in the
    /// box.
    Ray ray() {
        const float radius = 1.2f * 0.5f * diagonal();
        const Vec3 out = unit_vector();
        const Vec3 from = {center_.x + radius * out.x, center_.y + radius * out.y, center_.z + radius * out.z};
        return {.origin = from, .direction = difference(point_in_box(), from)};
    }

    /// Of the box, rounded up somewhat: the root is not worth a function.
    [[nodiscard]] float diagonal() const {
        const float squared = size_.x * size_.x + size_.y * size_.y + size_.z * size_.z;
        float root = extent_ * 1.7320509f;
        for (int i = 0; i < 4; ++i) root = 0.5f * (root + squared / root);
        return root;
    }

    Sphere sphere() { return {point_in_box(), 0.02f * diagonal()}; }

    Box box() {
        const Vec3 at = point_in_box();
        const float half = 0.02f * diagonal();
        return {{at.x - half, at.y - half, at.z - half}, {at.x + half, at.y + half, at.z + half}};
    }

    /// A box that is turned by 45 degrees about z.
    static OrientedBox turned_box(const Vec3& at, float half) {
        return {at, {{half, half, 0.0f}, {-half, half, 0.0f}, {0.0f, 0.0f, half}}};
    }

    Vec3 step() {  // a tenth of the box, in any direction
        const Vec3 direction = unit_vector();
        const float length = 0.1f * extent_;
        return {direction.x * length, direction.y * length, direction.z * length};
    }
    float symmetric() { return 2.0f * fraction() - 1.0f; }

private:
    Vec3 low_;
    Vec3 size_;
    Vec3 center_;
    float extent_ = 0.0f;
};

}  // namespace espalier::firmware
