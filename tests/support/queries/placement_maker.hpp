// Placements of one blob against another, easy and hard to answer: meshes that touch in a corner, lie in each other's
// planes, are turned by next to nothing, or differ in size and distance by powers of ten.
#pragma once

#include <espalier/transform.hpp>

#include "describe.hpp"
#include "surface.hpp"

namespace espalier::tests {

class PlacementMaker {
public:
    PlacementMaker(const DecodedBlob& a, const DecodedBlob& b, std::uint64_t seed);

    /// Any rotation, sizes within a factor of 4, so near that the boxes overlap: the kind that is not adversarial.
    Transform random();
    /// The same, but farther away by up to the larger one's size: most do not touch.
    Transform apart();
    Transform adversarial();

    // b's size is `proportion` times a's: a small mesh goes around on the surface of a large one.

    /// Any rotation; two places on the surfaces are up to some sizes of the smaller one apart, or much less.
    Transform beside(double proportion);
    /// A face of b in the plane of a face of a, as nearly as floats say, with a place in common: a corner, the middle
    /// of a side or inside. `proportion` is a power of two.
    Transform face_on_face(double proportion);
    [[nodiscard]] Random& numbers() { return random_; }

private:
    Quaternion any_rotation();
    /// Which takes axes to axes, or nothing anywhere.
    Quaternion axis_rotation();
    /// Such that point p of b lands on point q of a.
    static void move(Transform& placement, Vec3 p, Vec3 q);
    Vec3 some_corner(const DecodedBlob& blob);
    Vec3 some_place(const DecodedBlob& blob);
    Vec3 corner_of(const DecodedBlob& blob, const GridTriangle& triangle);
    Vec3 place_on(const DecodedBlob& blob, const GridTriangle& triangle);

    const DecodedBlob& a_;
    const DecodedBlob& b_;
    Random random_;
    double size_a_;
    double ratio_;  ///< of a's size to b's
};

}  // namespace espalier::tests
