// The two surfaces that are compared, in double precision.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <espalier/types.hpp>

#include "double_geometry.hpp"
#include "support/format/decoder.hpp"
#include "support/meshes/mesh.hpp"

namespace espalier::reference {

inline Point to_point(const Vec3& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

inline Point to_point(const tests::GridPoint& p) {
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

/// Not rounded to float: lattice coordinates times step, from the origin on.
[[nodiscard]] PointTriangle world_corners(const tests::DecodedBlob& decoded, const tests::GridTriangle& triangle);

/// All of them, those without area too.
[[nodiscard]] std::vector<PointTriangle> source_surface(const tests::Mesh& mesh);

/// As the tests' own decoder reads it.
[[nodiscard]] std::vector<PointTriangle> baked_surface(std::span<const std::byte> bytes);

}  // namespace espalier::reference
