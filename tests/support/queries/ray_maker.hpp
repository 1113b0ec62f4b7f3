// Queries that are hard to answer: most of them aim at what lies between triangles, or come from where floats are
// coarse.
#pragma once

#include <array>

#include <espalier/overlap.hpp>
#include <espalier/ray.hpp>

#include "describe.hpp"
#include "surface.hpp"

namespace espalier::tests {

enum class RayKind : std::uint8_t {
    incoherent,  ///< from a sphere around the asset through a point of its box: the one kind that is not adversarial
    through_vertex,    ///< exactly, or a few ulp beside it
    through_edge,      ///< through the middle of a side, or a few ulp beside it
    axis_parallel,     ///< through a vertex or the middle of a side, in both directions of every axis
    diagonal,          ///< with direction components of equal size, through a vertex
    in_plane,          ///< along a side, or a hair off it
    from_face,         ///< starting on a triangle, a side or a vertex
    far_ten_thousand,  ///< through a vertex or the middle of a side, from 10^4 sizes away
    far_million,       ///< from 10^6 sizes away
};
inline constexpr std::array all_ray_kinds = {RayKind::incoherent,    RayKind::through_vertex,   RayKind::through_edge,
                                             RayKind::axis_parallel, RayKind::diagonal,         RayKind::in_plane,
                                             RayKind::from_face,     RayKind::far_ten_thousand, RayKind::far_million};

class QueryMaker : public SurfaceMaker {
public:
    using SurfaceMaker::SurfaceMaker;

    Ray ray(RayKind kind);
    /// Two in eighteen are of the first kind.
    Ray any_ray();
    /// The window and the faces set to something else than everything.
    void restrict(Ray& ray);
    Sphere sphere();
    /// Anywhere near the asset, of any size up to its own, mostly small.
    Sphere random_sphere();

private:
    Vec3 some_edge_middle();
    Vec3 some_target();
    Vec3 around(double sizes);
    float nudged(float value);
};

}  // namespace espalier::tests
