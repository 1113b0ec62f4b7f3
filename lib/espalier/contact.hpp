// Contacts that slide over a mesh: which edges are real ones, and which only join two triangles of one surface.
//
// A body that slides over a flat floor of many triangles touches edges between them, with contact normals that lean
// against the motion: it stumbles over nothing. Blobs that were baked with edge flags know which edges these are.
// Engines have the same under the names of internal edges (Bullet), active edges (Jolt), edge flags (PhysX, Box3D).
//
// Arguments. Any bit pattern is safe. Bytes that a stranger made may carry wrong flags: they are hints, nothing more.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// How the surface bends at an edge, seen from the front of its triangles. Decided exactly on the baked triangles.
enum class EdgeKind : std::uint8_t {
    flat = 0,     ///< the normals of the two triangles differ by no more than the angle given at bake
    convex = 1,   ///< a ridge: the other triangle lies below this one's plane, or is folded back onto it
    concave = 2,  ///< a valley
    open = 3,     ///< not shared by exactly two triangles that run along it in opposite directions: a border, three
                  ///< triangles and more, or two that do not face the same way. A closed blob may have some, where a
                  ///< long edge lies on shorter ones or where surfaces touch in an edge
};

/// Corners are those of the blob (walk.hpp).
struct EdgeKinds {
    EdgeKind ab = EdgeKind::open;
    EdgeKind bc = EdgeKind::open;
    EdgeKind ca = EdgeKind::open;
};

/// False, and `kinds` untouched, when the blob carries no edge flags or has no such triangle. O(1).
bool edge_kinds(const Blob& blob, Triangle triangle, EdgeKinds& kinds) noexcept;

/// A point where a body touches a triangle. closest_triangles gives triangle and feature, one for each triangle nearby.
struct Contact {
    Triangle triangle;
    Feature feature = Feature::face;  ///< the part of the triangle that the contact lies on
    Vec3 normal;                      ///< from the surface to the body, of any length
};

/// Whether the contact lies on inner edges alone: on a flat or concave one, or on a corner between two such. If so,
/// `normal` becomes the normal that it should have: the triangle's, of length 1 (each coordinate within 4 ulp of 1), on
/// the side to which the contact's normal points. Otherwise, on a face, a convex or an open edge, or with a blob
/// without edge flags, `normal` is left alone: the contact's own is right.
///
/// A corner is judged by the two edges of its own triangle: where it also is the end of a ridge between other
/// triangles, their contacts keep their normals and this one does not.
bool is_on_inner_edge(const Blob& blob, const Contact& contact, Vec3& normal) noexcept;

}  // namespace espalier
