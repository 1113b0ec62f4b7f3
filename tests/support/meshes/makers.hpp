// Meshes that the tests make themselves, each with a property that some claim needs.
#pragma once

#include <cstdint>

#include "mesh.hpp"

namespace espalier::tests {

/// Closed: 8 vertices, 12 triangles, from `low` to `high` on every axis.
Mesh make_cube(float low, float high);
/// Closed: 20 * 4^level triangles of nearly equal size.
Mesh make_icosphere(unsigned level, double radius, Vec3 center);
/// Closed: slim triangles at two poles of high valence.
Mesh make_uv_sphere(unsigned rings, unsigned segments, double radius, Vec3 center);
/// Closed, with a hole through it: 2 * around * across triangles around the z axis.
Mesh make_torus(unsigned around, unsigned across, double major_radius, double minor_radius);
/// Closed, 1,280 triangles: radius 2 around (148376, 1234, -223423), where float32 has steps of 1/64.
Mesh make_far_sphere();
/// Open and exactly flat in z: 2 * side * side triangles.
Mesh make_plane_grid(unsigned side);
/// Open: a height field with 2 * side * side triangles.
Mesh make_terrain(unsigned side, std::uint64_t seed);
/// Open: triangles a thousand times longer than wide that share one corner.
Mesh make_needle_fan(unsigned count);
/// Open: triangles whose third corner nearly lies on the opposite edge.
Mesh make_slivers(unsigned count, std::uint64_t seed);
/// Open: triangles that overlap one another in a handful of shared planes, in both windings: ties everywhere.
Mesh make_coplanar_stacks(unsigned count, std::uint64_t seed);
/// Open: unconnected triangles of all sizes.
Mesh make_soup(unsigned count, std::uint64_t seed);
/// Long slanted triangles through a crowd of small ones: what spatial splits are for.
Mesh crossed_by_beams(unsigned beams, unsigned small, std::uint64_t seed);

/// The same mesh with every coordinate multiplied.
Mesh scaled_by(Mesh mesh, float factor);
Mesh moved_by(Mesh mesh, Vec3 way);

Mesh make_triangle(Vec3 a, Vec3 b, Vec3 c);
/// Adds a triangle with three vertices of its own.
void append_triangle(Mesh& mesh, Vec3 a, Vec3 b, Vec3 c);
void append(Mesh& mesh, const Mesh& other);
/// Both meshes as one.
Mesh joined(Mesh mesh, const Mesh& other);
Mesh turned_inside_out(Mesh mesh);

}  // namespace espalier::tests
