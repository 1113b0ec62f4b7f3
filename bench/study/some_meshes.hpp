// The small meshes that tests of the study's trees share, and poses of them.
#pragma once

#include "walks.hpp"

namespace espalier::bench {

inline std::vector<Mesh> some_meshes() {
    return {tests::make_torus(24, 10, 2.0, 0.6), tests::make_icosphere(2, 1.5, {4.0f, 0.0f, 0.0f}),
            tests::make_terrain(14, 1), tests::make_plane_grid(12), tests::make_soup(300, 2)};
}

/// Returns poses of which about half touch.
inline std::vector<Transform> poses_of(const Mesh& mesh, const AabbTree& tree) {
    PairWalk walk(tree, tree);
    return some_poses(mesh, 20, 7, [&](const Transform& pose) {
        return walk.run(PairRule::all_children, PairQuestion::any, Placement(pose)).pairs > 0;
    });
}

}  // namespace espalier::bench
