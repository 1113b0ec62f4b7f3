// Rays aimed at the edges and vertices that triangles share: where hits get lost.
#pragma once

#include "../base.hpp"

namespace espalier::bench {

/// A mesh whose vertices are points of a lattice, as a bake leaves them: equal ones are one, and every triangle has an
/// area. Floats represent its coordinates exactly, so that every system tests the same triangles.
struct SnappedMesh {
    Mesh mesh;
    double step = 0.0;
};
/// Throws std::runtime_error with the mesh's name.
[[nodiscard]] SnappedMesh snap_mesh(const Mesh& mesh, unsigned bits = 16);

enum class AimedAt : std::uint8_t {
    vertex,       ///< through a vertex, exactly: floats represent origin, direction and vertex
    edge_middle,  ///< through the middle of an edge, exactly
    edge_point,   ///< at any point of an edge, as exactly as floats represent a ray of length 1
};
inline constexpr std::array all_aims = {AimedAt::vertex, AimedAt::edge_middle, AimedAt::edge_point};
/// Returns the name in rows.
[[nodiscard]] std::string_view name_of(AimedAt aim);

/// A ray that meets the surface at the place that it is aimed at, or before it.
struct EdgeRay {
    Ray ray;
    float farthest = 0.0f;  ///< t a little behind that place
};

/// Returns whether the closest hit at t, infinity for none, lies behind the surface: the ray passed between triangles.
[[nodiscard]] inline bool is_leak(const EdgeRay& ray, float t) { return !(t <= ray.farthest); }

/// Returns rays from up to two radii away. The triangles at the place surround it, face the ray by at least a tenth
/// (the cosine), and reach much farther than the ray's own rounding. So a hit is certain, whatever else the mesh is.
/// Returns fewer rays than `count` where the mesh has few such places, and none for a mesh that is far from 0.
[[nodiscard]] std::vector<EdgeRay> edge_rays(const SnappedMesh& snapped, AimedAt aim, std::size_t count,
                                             std::uint64_t number);

}  // namespace espalier::bench
