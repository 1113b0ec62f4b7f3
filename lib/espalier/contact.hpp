// Contacts of a body with the surface, and edges that only join two triangles of one surface.
//
// find_contacts() lists where a body is near the surface or in it: places, directions and depths, for engines and
// character controllers. reduce_contacts() keeps the few of them that support the body.
//
// A body that slides over a flat floor of many triangles touches the edges between them. Contact normals there lean
// against the motion, and the body stumbles. A blob that was baked with BakeOptions::flat_angle stores for each edge
// how the surface bends there, so that such normals can be replaced. Engines call these edges internal edges (Bullet),
// active edges (Jolt) or edge flags (PhysX, Box3D).
//
// Any bit pattern is a safe argument. Untrusted bytes may carry wrong flags: then normals are wrong, safely. Thread
// safety: any number of threads may query one blob. No call allocates. Numerics are described at the end of this file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// A place where a body is near a triangle or in it.
struct Contact {
    Vec3 point;                       ///< on the triangle
    Vec3 normal;                      ///< unit length, from the surface to the body: along it the body leaves
    float distance = 0.0f;            ///< from the surface to the body along the normal; below 0 the depth
    TriangleId triangle;              ///< original_triangle() maps it to the source mesh
    Feature feature = Feature::face;  ///< the part of the triangle that holds the point
    Side side = Side::front;          ///< of the triangle, on which the middle of the body lies; of a long body that is
                                      ///< over another slope the side to which the normal leads
    std::uint8_t reserved[2] = {};
};

/// Writes the contacts of a body with the triangles that are no farther away than `margin`, sorted by distance: the
/// deepest first; of equally deep ones that of the lowest triangle, but for those whose depth was limited.
///
/// Each triangle is a sheet with two sides, and the body leaves it on the side where its middle lies. The normal is
/// that of the shortest way out or, where this would lead the middle through the triangle, that of the face. The
/// distance is minus the length of the way if the body overlaps the triangle, and else that of the two; no way is
/// longer than the longest of all shortest ones. A triangle has one contact with a sphere. With a capsule, a box or a
/// hull it has more, up to 8 with one normal, where a side or a face of the body lies over it: the ends of that part,
/// of a hull those that reach farthest. If the surface is closed and contains the middle of the body, that of a hull
/// the mean of its vertices, there is one contact, with the closest point of the surface to the middle: along its
/// normal the whole body leaves the inside.
///
/// In a blob with edge flags (BakeOptions::flat_angle) an edge is internal where the surface is flat, or a valley on
/// the side of the body's middle; so is a corner between two such edges of the triangle. On these a contact has the
/// normal of the face, if a part of the body, without its radius, is over the triangle: the depth takes that part out
/// of it. Where the middle is behind this triangle's plane but in front of the flat neighbor that it is over, the
/// normal is the neighbor's. Otherwise the contact is left out where another triangle at the same edge or corner is
/// nearer, or as near with a lower index. So a body on an even floor has contacts with the triangles below it alone.
///
/// Status: ok; output_full if all places are taken: of more contacts the deepest are kept; or a refusal: of an
/// infinite radius or margin or a margin below 0 (invalid_argument), and else as of overlaps(). A hull is refused as by
/// sweep(), and from 2^29 lattice steps on (out_of_range); one that is farther away than the margin has no contacts.
/// Cost: expected O(log n + k * places) for k triangles, times the edges of a hull, whose faces are found in
/// O(vertices^2); and of a closed surface that of contains(). With edge flags, a place on an internal edge or corner
/// costs the ways down to the triangles around it. With up to 4 places the nearest are looked for first, so
/// that a large margin costs little more than closest_point().
template <ContactBody Body>
Filled find_contacts(const Blob& blob, const Body& body, float margin, std::span<Contact> contacts) noexcept;

/// The largest number of contacts that reduce_contacts() keeps.
inline constexpr std::size_t max_reduced_contacts = 4;

/// Moves the contacts that support a body best to the front of the array and returns how many they are, at most
/// max_reduced_contacts. A contact supports by its normal, and by the lever of that force about the middle of all
/// points. Contacts that touch, those of a distance of 0 or less, come first, or the nearest where none does; the
/// others fill the places that are left. The first kept has the longest lever, each other one is the farthest from the
/// hull of those before; contacts that support alike count once. If a contact is deeper than all of these by more than
/// a 256th of how far the points reach from their middle along an axis, for the side of a cube a 512th of its edge, it
/// replaces the one that is most like it. The deepest comes first. Cost: O(contacts).
std::size_t reduce_contacts(std::span<Contact> contacts) noexcept;

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
/// On an internal edge, one that is flat or a valley on the side to which `normal` points, or on a corner between two
/// such edges of this triangle, returns the triangle's own normal on that side, of length 1. Where `normal` lies nearly
/// in the plane of the triangle the side is in doubt: find_contacts() takes that of the body's middle. Otherwise
/// returns `normal`: on a face, a ridge or a boundary, for a blob without edge flags, and for a triangle that the blob
/// does not have. A corner is judged by the edges of its own triangle, also where a ridge between other triangles ends.
/// Cost: O(depth), the way down to the triangle.
[[nodiscard]] Vec3 fix_internal_edge_normal(const Blob& blob, TriangleId triangle, Feature feature,
                                            Vec3 normal) noexcept;

}  // namespace espalier

// Numerics
//
// Body and margin are rounded once, as by overlaps(), a hull as by sweep() with no displacement. Which triangles are
// within the margin of a sphere or a capsule is decided exactly; of a box or a hull as its distance is. Distances of
// spheres and capsules are within 8 ulp, or 8 ulp of the radius where that is more; their features are exact, their
// normals within 8 ulp of 1. That is so for the first contact of a triangle whose edges are not corrected; distances of
// others are within 2^-22 of the size of triangle and body, and of a body whose middle is inside a closed surface
// within 2^-20 of the largest coordinate of both, its normal over an edge within this length over the distance to the
// surface. Coordinates of points are within 14 ulp of the largest coordinate of the asset's bounds. Distances and
// points of a box or a hull are within 2^-18 of the length that it and the triangle reach from its middle. Its normals
// have an error of this length over the distance, where it does not touch the triangle; the direction of a touching one
// separates it by its depth, with that error. The faces of a hull are those of its rounded vertices, exactly.
//
// fix_internal_edge_normal(). Each coordinate of a triangle's normal is within 4 ulp of 1 of the exact one.
