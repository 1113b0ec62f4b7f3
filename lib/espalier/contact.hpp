// Contacts of a body with the surface, and corrected normals at internal edges, which only join two triangles of one
// surface.
//
// find_contacts() lists where a body touches the surface or is near it, with directions and depths, for physics engines
// and character controllers. reduce_contacts() keeps the few contacts that support the body.
//
// A body that slides over a flat floor of many triangles touches the edges between them, where contact normals may lean
// against the motion, so that the body stumbles. A blob that was baked with BakeOptions::flat_angle stores how the
// surface bends at each edge, which allows such normals to be replaced. Engines call these edges internal edges
// (Bullet), active edges (Jolt) or edge flags (PhysX, Box3D).
//
// Every bit pattern is a safe argument. Untrusted bytes may contain wrong edge flags: normals are then wrong, but
// nothing worse happens. Any number of threads may query the same blob, and no call allocates. Numerics are described
// at the end of this file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// Where a body touches a triangle or is near it.
struct Contact {
    Vec3 point;             ///< on the triangle
    Vec3 normal;            ///< unit length, from the surface to the body: the direction in which the body leaves
    float distance = 0.0f;  ///< from the surface to the body along the normal; if negative, minus the depth
    TriangleId triangle;    ///< original_triangle() maps it to the source mesh
    Feature feature = Feature::face;  ///< the part of the triangle that contains the point
    Side side = Side::front;  ///< the side of the triangle on which the middle of the body lies; if a long body has its
                              ///< middle over another slope, the side to which the normal leads
    std::uint8_t reserved[2] = {};
};

/// Writes the contacts of a body with the triangles that are at most `margin` away, sorted by distance, the deepest
/// first. Of equally deep contacts, that of the lowest triangle comes first, except for those whose depth was limited.
///
/// Each triangle is a sheet with two sides, and the body leaves it on the side where its middle lies. The normal is
/// that of the shortest way out or, where this would lead the middle through the triangle, the normal of the face. If
/// the body overlaps the triangle, the distance is minus the length of that way, but never deeper than the body is in
/// any one triangle by its shortest way; otherwise it is the distance between the two. A sphere has one contact with
/// each triangle. Where a side or face of a capsule, a box or a hull lies over the triangle there are more, up to 8
/// with the same normal: the ends of that part or, for a hull, the points that reach farthest.
///
/// If the surface is closed and its winding number around the middle of the body is above 0 (for a hull, around the
/// mean of its vertices), the body is inside a solid. It then has a single contact, at the point of the surface closest
/// to the middle, along whose normal the whole body leaves the inside. In a room whose triangles face inward the number
/// is below 0, and the body meets the walls.
///
/// In a blob with edge flags (BakeOptions::flat_angle) an edge is internal where the surface is flat, or where it forms
/// a valley on the side of the body's middle; a corner between two such edges of a triangle is internal too. There, a
/// contact takes the normal of the face if a part of the body, without its radius, is over the triangle, and the depth
/// that takes that part out of it. Where the middle is behind the plane of this triangle but in front of a flat
/// neighbour that it is over, the normal is the neighbour's. Otherwise the contact is dropped if another triangle at
/// the same edge or corner is nearer, or as near with a lower index. A body on an even floor thus has contacts only
/// with the triangles below it.
///
/// Returns ok; output_full if the array is full, in which case there may be more contacts and the deepest are kept; or
/// a refusal: an infinite radius or margin or a negative margin is an invalid_argument, and everything else is refused
/// like overlaps() does. A hull is refused like sweep() does, and from 2^29 lattice steps on (out_of_range); a hull
/// farther away than the margin has no contacts. Expected cost: O(log n + k * contacts.size()) for k triangles,
/// multiplied by the edges of a hull, whose faces are found in O(vertices^2), plus that of contains() for a closed
/// surface. With edge flags, a contact on an internal edge or corner also costs the ways down to the triangles around
/// it. If there is room for at most 4 contacts, the nearest are searched for first, so that a large margin costs little
/// more than closest_point().
template <ContactBody Body>
Filled find_contacts(const Blob& blob, const Body& body, float margin, std::span<Contact> contacts) noexcept;

/// The largest number of contacts that reduce_contacts() keeps.
inline constexpr std::size_t max_reduced_contacts = 4;

/// Moves the contacts that support a body best to the front of the array and returns their number, at most
/// max_reduced_contacts. A contact supports the body by its normal and by the lever of that force about the middle of
/// all points. Touching contacts, whose distance is 0 or less, are chosen first, or the nearest one if none touches;
/// the others fill the remaining room. The first choice has the longest lever, and each further one is the farthest
/// from the hull of those before it; contacts that support alike count once. A contact that is clearly deeper than all
/// of these, by more than a 256th of how far the points reach from their middle along an axis (for the side of a cube,
/// a 512th of its edge), replaces the one most like it. The deepest contact comes first. O(contacts.size()).
std::size_t reduce_contacts(std::span<Contact> contacts) noexcept;

/// A plane that holds a capsule back: it lies between the capsule and the surface at one of the surface's places.
struct ContactPlane {
    Vec3 normal;            ///< unit length, from the surface to the capsule
    float distance = 0.0f;  ///< from the surface to the capsule along the normal; if negative, minus the depth
    TriangleId triangle;
};

/// Writes the planes that hold back a capsule which moves by at most `margin`, sorted by distance, on a tie by
/// triangle.
///
/// A triangle that is at most `margin` away has a plane where its place nearest to the axis is on its face, or on an
/// edge or corner at which no other triangle is nearer, or as near with a lower index. An even floor thus has one
/// plane, whichever of its triangles lie around the capsule, and the edge of a step has one that leans: also without
/// edge flags. Normal and distance are those of find_contacts() for the triangle as a sheet with two sides. A plane is
/// left out if a nearer one says the same: if no way of at most margin + radius (+ its depth) that keeps off it comes
/// farther beyond it than a 256th of that.
///
/// They are the planes before the capsule moves. Beyond an edge it may meet a slope that none of them is about, so
/// sweep the way that solve_planes() returns.
///
/// Returns ok; output_full if there are more planes than places, and the nearest are kept; or a refusal as of
/// find_contacts(). Expected cost: O(log n + k²) for k triangles that are near, up to 64; beyond, every one that is
/// nearest at an edge or corner costs a way down to the triangles around it.
Filled collect_planes(const Blob& blob, const Capsule& capsule, float margin, std::span<ContactPlane> planes) noexcept;

/// Returns the way nearest to `wish` that comes no nearer to any plane than `skin`, and that leaves by as much where
/// the body is nearer. The planes of a wall and a floor give the way along both; those of a corner may leave none.
///
/// The status is ok; not_found if no way keeps off all planes, as between a floor and a ceiling that are too near, or
/// between two that meet at less than 2^-10; or
/// invalid_argument for numbers that are not finite or a skin below 0. The way is exact but for rounding, some 2^-19 of
/// wish, skin and distances. O(planes.size()) as a rule, O(planes.size()³) at worst (Seidel 1991).
[[nodiscard]] Result<Vec3> solve_planes(std::span<const ContactPlane> planes, Vec3 wish, float skin) noexcept;

/// How the surface bends at an edge, as seen from the front of its triangles. Decided exactly for the baked triangles.
enum class EdgeKind : std::uint8_t {
    flat = 0,      ///< the normals of the two triangles differ by at most BakeOptions::flat_angle
    convex = 1,    ///< a ridge: the other triangle lies below the plane of this one, or is folded back onto it
    concave = 2,   ///< a valley
    boundary = 3,  ///< not shared by exactly two triangles that run along it in opposite directions: a border, three or
                   ///< more triangles, or two that face different ways. A closed blob may have some, where a long edge
                   ///< lies on shorter ones or where surfaces touch along an edge
};

/// The kinds of a triangle's edges, which run between the corners that triangle_at() returns.
struct EdgeKinds {
    EdgeKind ab = EdgeKind::boundary;
    EdgeKind bc = EdgeKind::boundary;
    EdgeKind ca = EdgeKind::boundary;
};

/// Returns the kinds of a triangle's edges.
///
/// The status is ok; not_open; no_data (baked without flat_angle); not_found for no_triangle; or invalid_argument for a
/// triangle that the blob does not have. O(1).
Result<EdgeKinds> edge_kinds(const Blob& blob, TriangleId triangle) noexcept;

/// Returns the normal to use for a contact on `feature` of `triangle`. `normal` leads from the surface to the body and
/// may have any length. closest_triangles() returns such a triangle and feature for each triangle nearby.
///
/// An edge is internal if it is flat, or a valley on the side to which `normal` points; a corner is if it lies between
/// two such edges of this triangle. There, the function returns the triangle's own unit normal on that side. If
/// `normal` lies nearly in the plane of the triangle, the side is uncertain; find_contacts() uses the side of the
/// body's middle instead. In all other cases `normal` is returned unchanged: on a face, a ridge or a boundary, for a
/// blob without edge flags, and for a triangle that the blob does not have. Only the edges of its own triangle decide
/// about a corner, even if a ridge between other triangles ends there. Cost: O(depth), for the way down to the
/// triangle.
[[nodiscard]] Vec3 fix_internal_edge_normal(const Blob& blob, TriangleId triangle, Feature feature,
                                            Vec3 normal) noexcept;

}  // namespace espalier

// Numerics
//
// Body and margin are rounded once, as in overlaps(); a hull as in sweep() without displacement. Which triangles are
// within the margin is decided exactly for a sphere or a capsule, and within the error of its distances for a box or a
// hull.
//
// Spheres and capsules. Distances are within 8 ulp, or within 8 ulp of the radius if that is more; features are exact,
// and normals within 8 ulp of 1. This holds for the first contact of a triangle whose edges are not corrected. The
// distances of other contacts are within 2^-22 of the size of triangle and body. Coordinates of points are within 14
// ulp of the largest coordinate of the asset's bounds.
//
// Boxes and hulls. Distances and points are within 2^-18 of the length that the body and the triangle reach from the
// body's middle. Normals have an error of that length over the distance where the body does not touch the triangle;
// where it does, moving it along the normal by its depth separates it, within that error. The faces of a hull are
// exactly those of its rounded vertices.
//
// Inside. If the middle of a body is inside a closed surface, the distance is within 2^-20 of the largest coordinate of
// both, and the normal over an edge has an error of that length over the distance to the surface.
//
// fix_internal_edge_normal(). Each coordinate of a triangle's normal is within 4 ulp of 1 of the exact one.
