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

class SweepMaker {
public:
    SweepMaker(const DecodedBlob& decoded, std::uint64_t seed);

    /// From anywhere in or near the asset to anywhere in or near it, with shapes of a few hundredths of its size.
    Moving<Sphere> random_sphere();
    Moving<Capsule> random_capsule();
    Moving<Box> random_box();
    Moving<OrientedBox> random_oriented_box();
    Moving<OwnedHull> random_hull();
    /// Grazing a vertex, starting on one, in a triangle's plane, along an axis, from 10^4 sizes away, without a way or
    /// a size.
    Moving<Sphere> awkward_sphere();
    Moving<Capsule> awkward_capsule();
    Moving<Box> awkward_box();
    /// Also flat, sheared or along the axes.
    Moving<OrientedBox> awkward_oriented_box();
    /// Also of few or of most vertices, of repeated ones, in one plane, or a triangle of the mesh.
    Moving<OwnedHull> awkward_hull();

private:
    struct Path {
        Vec3 start;
        Vec3 way;
    };
    Vec3 some_place();
    Vec3 some_vertex();
    std::vector<Vec3> some_triangle();
    float some_radius();
    Path random_path();
    Path awkward_path(float radius);
    Vec3 some_size(float radius);

    const DecodedBlob& decoded_;
    QueryMaker maker_;
    float step_;
    float size_;
};

/// The bits of a query in hexadecimal, to repeat a failure.
std::string describe(const Moving<Sphere>& moving);
std::string describe(const Moving<Capsule>& moving);
std::string describe(const Moving<Box>& moving);
std::string describe(const Moving<OrientedBox>& moving);
std::string describe(const Moving<OwnedHull>& moving);

}  // namespace espalier::tests
