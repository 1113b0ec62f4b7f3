// Shapes and rays moved into the local space of a transform, as to_local() does; of a convex hull each of its vertices.
#pragma once

#include <cstddef>

#include <espalier/ray.hpp>
#include <espalier/shapes.hpp>
#include <runtime/transforms/rotation.hpp>

namespace espalier::detail {

/// A shape in the local space of an instance.
template <class Shape>
class LocalShape {
public:
    LocalShape(const Transform& transform, const Shape& world) : shape_(to_local(transform, world)) {}
    [[nodiscard]] const auto& shape() const { return shape_; }

private:
    decltype(to_local(Transform(), Shape())) shape_;  // of a Box an OrientedBox
};
/// A hull with its vertices, of which it has at most max_hull_vertices.
template <>
class LocalShape<ConvexHull> {
public:
    ESPALIER_NOINLINE LocalShape(const Transform& transform, const ConvexHull& world) : count_(world.vertices.size()) {
        if (is_identity(transform)) {
            for (std::size_t i = 0; i < count_; ++i) vertices_[i] = world.vertices[i];
            return;
        }
        const PreparedTransform prepared(transform);
        for (std::size_t i = 0; i < count_; ++i) vertices_[i] = prepared.point_to_local(world.vertices[i]);
    }

    [[nodiscard]] ConvexHull shape() const { return {{vertices_, count_}}; }

private:
    std::size_t count_;
    Vec3 vertices_[max_hull_vertices];
};

/// Returns the ray moved into local space, or the ray itself if the transform changes nothing. Here, so that it is
/// computed in the frame of its caller.
ESPALIER_SHARED_OR_PART_OF_CALLER inline Ray local_ray(const Transform& transform, const Ray& ray) {
    Ray local = ray;
    if (is_identity(transform)) return local;
    const PreparedTransform prepared(transform);
    local.origin = prepared.point_to_local(ray.origin);
    local.direction = prepared.direction_to_local(ray.direction);
    return local;
}

}  // namespace espalier::detail
