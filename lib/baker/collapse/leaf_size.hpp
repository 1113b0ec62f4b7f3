// The bytes that a leaf would take, which the collapse computes for every small subtree.
#pragma once

#include <cstddef>
#include <memory>

#include <baker/build/binary_tree.hpp>
#include <baker/collapse/strip.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

struct LeafSize {
    bool fits = false;      ///< the profile allows such a leaf
    unsigned slots = 0;     ///< tested for each ray: triangles, and what joins strips
    std::size_t bytes = 0;  ///< of a strip close to it: its box in the node may turn out larger, and a width with it
};

/// Leaves of one profile.
class LeafSizes {
public:
    virtual ~LeafSizes() = default;
    /// `vertices` is how many distinct ones the node's triangles have, `node.count` at most most_triangles().
    [[nodiscard]] virtual LeafSize of(const BinaryNode& node, unsigned vertices) const = 0;
    [[nodiscard]] virtual unsigned most_triangles() const = 0;
    /// Returns the profile's factor on the price of a byte.
    [[nodiscard]] virtual float byte_weight() const = 0;
};

/// On a lattice of so many bits. `strips` is null for profile fast alone.
[[nodiscard]] std::unique_ptr<LeafSizes> leaf_sizes(Profile profile, unsigned bits, const StripMaker* strips,
                                                    bool has_corners = true);

/// Returns the triangles of a full leaf, for the builder: the most of a plain leaf, seven eighths of the most of a
/// predicted strip, since the entries that join paths count too, and no more than `max_leaf_triangles`; 0 for other
/// strips, which are left as the heuristic makes them.
[[nodiscard]] unsigned full_leaf(Profile profile, unsigned max_leaf_triangles);

}  // namespace espalier::baker
