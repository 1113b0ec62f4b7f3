// Where two triangles of a common integer grid touch.
#pragma once

#include <cstdint>

#include <runtime/contacts/touch.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail::contacts {

/// The corners of what two triangles have in common, and the shortest way out, in steps of the grid.
struct TrianglesTouch {
    static constexpr unsigned most = 6;

    Vec3 point[most];
    unsigned count = 0;
    Vec3 normal;         ///< unit length, along which b leaves a
    float depth = 0.0f;  ///< how far it has to go

    void add(const Vec3& at) {
        if (count != most) point[count++] = at;
    }
};

/// Finds where two triangles touch: no point if they do not. Their coordinates are below 2^25.
void touch_triangles(const LatticeTriangle& a, const LatticeTriangle& b, TrianglesTouch& touch) noexcept;

}  // namespace espalier::detail::contacts
