// Shapes to ask a blob with: random ones, and ones that touch it, lie flat in its planes, have no size, or are far
// away.
#pragma once

#include <string>
#include <vector>

#include <espalier/shapes.hpp>
#include <espalier/types.hpp>

#include "describe.hpp"
#include "surface.hpp"

namespace espalier::tests {

class ShapeMaker : public SurfaceMaker {
public:
    using SurfaceMaker::SurfaceMaker;

    /// Of each shape: `awkward` ones touch, or nearly.
    Capsule capsule(bool awkward);
    Box box(bool awkward);
    OrientedBox oriented_box(bool awkward);
    Triangle corners(bool awkward);
    ConvexVolume planes(bool awkward);  ///< until the next call

    /// Calls add(shape) with a shape of each kind that volumes take.
    template <class Add>
    void make_volumes(bool awkward, const Add& add) {
        add(capsule(awkward));
        add(box(awkward));
        add(oriented_box(awkward));
        add(corners(awkward));
        add(planes(awkward));
    }

    /// Near the surface, or anywhere in a box half again as large as the asset's.
    Vec3 point_around();
    /// On a corner, a side or inside of a triangle, but for rounding.
    Vec3 surface_point();

private:
    /// Mostly small, of all sizes.
    float length();
    float nudged(float value);
    Vec3 nudged(Vec3 value);
    Vec3 direction();

    std::vector<Plane> planes_;
};

std::string describe(const ConvexVolume& volume);

}  // namespace espalier::tests
