// Between building and collapsing: subtrees move to where they cost less.
#pragma once

#include <espalier/bake.hpp>

#include <baker/build/binary_tree.hpp>

namespace espalier::baker {

struct OptimiseSettings {
    unsigned passes = 0;                ///< over all subtrees; 0 leaves the tree as it is
    std::uint32_t least_triangles = 8;  ///< smaller subtrees move as a whole
    unsigned most_height = max_binary_height;
};

[[nodiscard]] OptimiseSettings optimise_settings(Effort effort);

/// Takes subtrees out, the largest boxes first, and puts each where the sum of all boxes' areas becomes least: "Fast
/// insertion- based optimization of bounding volume hierarchies" (Bittner, Hapala, Havran 2013), with the search of
/// "Parallel reinsertion for bounding volume hierarchy optimization" (Meister, Bittner 2018). One thread; the result
/// depends on the tree alone. Where it would become higher than allowed, it is lowered as by `lay_out`,
/// or left as it was if that costs more than moving saved.
[[nodiscard]] BinaryTree optimise(BinaryTree tree, const OptimiseSettings& settings);

}  // namespace espalier::baker
