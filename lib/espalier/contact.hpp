// Contacts on edges that only join two triangles of one surface.
//
// A body that slides over a flat floor of many triangles touches the edges between them. Contact normals there lean
// against the motion, and the body stumbles. A blob that was baked with BakeOptions::flat_angle stores for each edge
// how the surface bends there, so that such normals can be replaced. Engines call these edges internal edges (Bullet),
// active edges (Jolt) or edge flags (PhysX, Box3D).
//
// Any bit pattern is a safe argument. Untrusted bytes may carry wrong flags: then normals are wrong, safely. Thread
// safety: any number of threads may query one blob. No call allocates. Numerics are described at the end of this file.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// The bend of the surface at an edge, seen from the front of its triangles. Decided exactly on the baked triangles.
enum class EdgeKind : std::uint8_t {
    flat = 0,      ///< the normals of the two triangles differ by at most BakeOptions::flat_angle
    convex = 1,    ///< a ridge: the other triangle lies below this one's plane, or is folded back onto it
    concave = 2,   ///< a valley
    boundary = 3,  ///< not shared by exactly two triangles that run along it in opposite directions: a border, three
                   ///< triangles or more, or two that face different ways. A closed blob may have some, where a long
                   ///< edge lies on shorter ones or where surfaces touch in an edge
};

/// The kinds of a triangle's edges, between the corners that triangle_at() returns.
struct EdgeKinds {
    EdgeKind ab = EdgeKind::boundary;
    EdgeKind bc = EdgeKind::boundary;
    EdgeKind ca = EdgeKind::boundary;
};

/// Returns the kinds of a triangle's edges.
///
/// Status: ok; not_open; no_data (baked without flat_angle); not_found for no_triangle; or invalid_argument for a
/// triangle that the blob does not have. Cost: O(1).
Result<EdgeKinds> edge_kinds(const Blob& blob, TriangleId triangle) noexcept;

/// Returns the normal to use for a contact on `feature` of `triangle`, where `normal` leads from the surface to the
/// body and has any length. closest_triangles() returns triangle and feature, one of each triangle nearby.
///
/// On a flat or concave edge, or on a corner between two such edges of this triangle, returns the triangle's own
/// normal, of length 1, on the side to which `normal` points. Otherwise returns `normal`: on a face, a convex edge or a
/// boundary, for a blob without edge flags, and for a triangle that the blob does not have. A corner is judged by the
/// edges of its own triangle, also where a ridge between other triangles ends. Cost: O(depth), the way down to the
/// triangle.
[[nodiscard]] Vec3 fix_internal_edge_normal(const Blob& blob, TriangleId triangle, Feature feature,
                                            Vec3 normal) noexcept;

}  // namespace espalier

// Numerics. Each coordinate of a triangle's normal is within 4 ulp of 1 of the exact one.
