// Moving shapes that are hard to answer for: most of them just touch something, at the start, on the way or at its end.
#pragma once

#include <string>
#include <vector>

#include <espalier/shapes.hpp>

#include "ray_maker.hpp"

namespace espalier::tests {

template <class Shape>
struct Moving {
    Shape shape;
    Vec3 displacement;
};

/// A hull with vertices of its own.
struct OwnedHull {
    std::vector<Vec3> vertices;
    operator ConvexHull() const { return {vertices}; }  // NOLINT(google-explicit-constructor): queries take the view
};

/// Returns a shape as queries take it.
template <class Shape>
const Shape& query_shape(const Shape& shape) {
    return shape;
}
inline ConvexHull query_shape(const OwnedHull& hull) { return hull; }

/// Half of them, the awkward ones, graze a vertex, start on one, are in a triangle's plane, along an axis, from 10^4
/// sizes away, without a way or a size. The others go from anywhere in or near the asset to anywhere in or near it,
/// with shapes of a few hundredths of its size.
class SweepMaker : QueryMaker {
public:
    using QueryMaker::QueryMaker;

    Moving<Sphere> sphere(bool awkward);
    Moving<Capsule> capsule(bool awkward);
    Moving<Box> box(bool awkward);
    /// Also flat, sheared or along the axes.
    Moving<OrientedBox> oriented_box(bool awkward);
    /// Also of few or of most vertices, of repeated ones, in one plane, or a triangle of the mesh.
    Moving<OwnedHull> hull(bool awkward);
    /// Calls add(moving, kind) with a shape of each of the five kinds.
    template <class Add>
    void make_shapes(bool awkward, const Add& add) {
        add(sphere(awkward), 0);
        add(capsule(awkward), 1);
        add(box(awkward), 2);
        add(oriented_box(awkward), 3);
        add(hull(awkward), 4);
    }

private:
    struct Path {
        Vec3 start;
        Vec3 way;
    };
    [[nodiscard]] float step() const;
    float some_radius();
    Path random_path();
    Path awkward_path(float radius);
    Vec3 some_size(float radius);
};

std::string describe(const OwnedHull& hull);
template <class Shape>
std::string describe(const Moving<Shape>& moving) {
    return describe(moving.shape) + "by " + describe(moving.displacement);
}

}  // namespace espalier::tests
