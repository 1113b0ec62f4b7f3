// Shapes to ask a blob with: random ones, and ones that touch it, lie flat in its planes, have no size, or are far
// away.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <espalier/shapes.hpp>
#include <espalier/types.hpp>

#include "support/base/random.hpp"
#include "support/format/decoder.hpp"

namespace espalier::tests {

class ShapeMaker {
public:
    ShapeMaker(const DecodedBlob& decoded, std::uint64_t seed);

    /// Of each shape: `awkward` ones touch, or nearly.
    Capsule capsule(bool awkward);
    Box box(bool awkward);
    OrientedBox oriented_box(bool awkward);
    Triangle corners(bool awkward);
    ConvexVolume planes(bool awkward);  ///< until the next call

    [[nodiscard]] Random& random() { return random_; }
    /// Near the surface, or anywhere in a box half again as large as the asset's.
    Vec3 point_around();
    /// A corner of a triangle.
    Vec3 vertex();
    /// On a corner, a side or inside of a triangle, but for rounding.
    Vec3 surface_point();
    [[nodiscard]] float size() const { return size_; }

private:
    [[nodiscard]] Vec3 to_world(double x, double y, double z) const;
    [[nodiscard]] Vec3 to_world(const GridPoint& p) const { return to_world(p[0], p[1], p[2]); }
    const GridTriangle& triangle();
    /// Mostly small, of all sizes.
    float length();
    float nudged(float value);
    Vec3 nudged(Vec3 value);
    Vec3 direction();

    const DecodedBlob& decoded_;
    Random random_;
    float size_;
    std::vector<Plane> planes_;
};

/// The bits of a shape in hexadecimal, to repeat a failure.
std::string describe(const Capsule& capsule);
std::string describe(const Box& box);
std::string describe(const OrientedBox& box);
std::string describe(const Triangle& corners);
std::string describe(const ConvexVolume& volume);

}  // namespace espalier::tests
