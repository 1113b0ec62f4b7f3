// Whether a triangle touches an axis-aligned box.
#pragma once

#include "../deformation/box_tree.hpp"
#include "../volumes/tests.hpp"

namespace espalier::bench {

/// A box, prepared for the test of "Fast 3D triangle-box overlap testing" (Akenine-Möller 2001), in double: the axes of
/// the box, the triangle's normal, and the nine cross products of edges. Touching counts.
class TriangleBoxTest {
public:
    explicit TriangleBoxTest(const Aabb& box);
    [[nodiscard]] bool touches(const Corners3& triangle) const;

private:
    Point center_;
    Point half_;
};

}  // namespace espalier::bench
