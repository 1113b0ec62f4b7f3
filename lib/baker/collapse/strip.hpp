// A leaf's triangles as strips: paths from neighbour to neighbour, joined to one sequence of vertices. How a sequence
// is read is in format/leaves.hpp, at `strip_leaf` and `predicted_strip`.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <espalier/format.hpp>

#include <baker/build/binary_tree.hpp>
#include <baker/collapse/neighbours.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

struct Strip {
    struct Triangle {
        std::uint32_t place;        ///< in BinaryTree::triangles
        std::uint8_t first_corner;  ///< which of its corners the sequence gives as its first
    };
    std::array<std::uint32_t, format::max_leaf_entries> entries;  ///< vertices of the mesh
    std::array<Triangle, format::max_leaf_triangles> triangles;   ///< in the order of their windows
    unsigned entry_count = 0;
    unsigned triangle_count = 0;
    std::uint64_t pivots = 0;   ///< a bit for each entry
    std::uint64_t windows = 0;  ///< a bit for each window that is a triangle
};

class StripMaker {
public:
    StripMaker(const LatticeMesh& mesh, const BinaryTree& tree, Profile profile = Profile::small)
        : mesh_(mesh), tree_(tree), profile_(profile), neighbours_(mesh, tree) {}

    [[nodiscard]] const LatticeMesh& mesh() const { return mesh_; }

    /// Returns the entries of the strip that `make` returns: one for each triangle and two for each path. Requires at
    /// most format::max_leaf_triangles triangles.
    [[nodiscard]] unsigned entries_of(const BinaryNode& node) const;

    /// Returns the strip of a node's triangles with the fewest entries of several attempts, of equal ones the one whose
    /// triangles follow each other most closely in the source. Requires that they fit.
    [[nodiscard]] Strip make(const BinaryNode& node) const;

    /// The strip of a node's triangles that takes the fewest bits as a predicted one, of the attempts that fit into a
    /// leaf; nothing when none does. Requires at most format::max_leaf_triangles with at most
    /// format::max_leaf_vertices.
    [[nodiscard]] std::optional<Strip> make_predicted(const BinaryNode& node, unsigned attempts) const;

    /// The strip of a leaf, as its profile writes it.
    [[nodiscard]] Strip make_leaf(const BinaryNode& node) const;

private:
    const LatticeMesh& mesh_;
    const BinaryTree& tree_;
    Profile profile_;
    Neighbours neighbours_;
};

/// From how many starts a predicted strip is tried when a leaf is planned, and when it is written: from those of
/// planning too, and from every triangle.
inline constexpr unsigned predicted_planning_attempts = 2;
inline constexpr unsigned predicted_writing_attempts = format::max_leaf_triangles + 1;

}  // namespace espalier::baker
