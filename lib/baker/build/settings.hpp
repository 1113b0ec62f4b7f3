// The parameters of every builder.
#pragma once

#include <functional>

#include <espalier/bake.hpp>

#include <baker/build/binary_tree.hpp>

namespace espalier::baker {

struct BuildSettings {
    unsigned bins = 32;                 ///< candidate planes per axis, for large nodes
    unsigned exact_below = 8;           ///< nodes with at most this many triangles try every split
    unsigned full_leaf = 0;             ///< triangles of a full leaf, so that few leaves result; 0: leaves are small
    unsigned clusters_from = 20;        ///< agglomeration starts with this many triangles
    unsigned most_insert_places = 256;  ///< looked at for one inserted triangle
    double duplicate_budget = 0.3;      ///< spatial splits may store this share of the triangles again
    unsigned threads = 1;
    unsigned most_height = max_binary_height;  ///< the heuristic yields to balance where it would build higher
    std::function<void(double)> progress;      ///< share of triangles placed, 0..1; called from the calling thread
};

[[nodiscard]] BuildSettings build_settings(Effort effort, unsigned threads);

/// Whether a node at `depth` whose larger child has `child_count` triangles leaves that child room for a balanced tree.
[[nodiscard]] constexpr bool leaves_room(unsigned depth, std::uint32_t child_count, unsigned most_height) {
    return depth + 1 + balanced_height(child_count) <= most_height;
}

}  // namespace espalier::baker
