// The boxes of instances: in the world, and on the lattice of the tree over them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <espalier/scene.hpp>

#include <baker/encode/node.hpp>
#include <baker/scenes/part.hpp>
#include <baker/verify/decode_tree.hpp>

namespace espalier::baker {

/// A box in the world.
struct WorldBox {
    std::array<double, 3> lo;
    std::array<double, 3> hi;
};

/// The boxes of the nodes and leaves of a mesh or a tile. Those farthest along an axis of the world bound it there, and
/// leave less room around it than its own box does.
class PartBoxes {
public:
    explicit PartBoxes(const ScenePart& part);

    /// Returns a box that contains the part at that place, however its corners are rounded on the way to the world. For
    /// a part without triangles it is the place of the local origin. Cost: a few hundred boxes for each side.
    [[nodiscard]] WorldBox at(const Transform& transform) const;
    /// Returns a box that contains the part's whole lattice at that place, and the local origin.
    [[nodiscard]] WorldBox lattice_at(const Transform& transform) const;

private:
    using Vector = std::array<double, 3>;

    /// A box in local space.
    struct LocalBox {
        Vector center;
        Vector half;

        LocalBox(const detail::BlobData& tree, const DecodedBox& box);
        /// Returns the largest dot product of a direction and a point of the box.
        [[nodiscard]] double farthest(const Vector& direction) const;
        /// Returns the largest sum of the magnitudes of a point's coordinates.
        [[nodiscard]] double size() const;
    };
    /// The box of a node or a leaf.
    struct Node {
        LocalBox box;
        std::uint32_t first_child = 0;
        std::uint32_t children = 0;  ///< none for a leaf
    };

    void add_nodes(const TreeBytes& tree, const detail::BlobData& data, const DecodedBox& whole);
    /// Returns the largest dot product of a direction and a point of the part, or a little more.
    [[nodiscard]] double farthest(const Vector& direction) const;

    std::vector<Node> nodes_;        ///< breadth first
    std::vector<LocalBox> lattice_;  ///< one, or none without triangles
    double size_ = 0.0;              ///< the largest size of a leaf; of a deformable mesh at least that of its range
};

/// The lattice of a scene's tree, and the boxes of the instances on it.
struct BoxLattice {
    Vec3 origin;
    int step_exponent = 0;
    std::array<std::int32_t, 3> extent{};
    std::vector<ChildBox> boxes;
};

/// Returns the finest lattice whose region holds the boxes of both kinds, and those of the first rounded outward onto
/// it. False if none does: they are not finite, or farther apart than every lattice reaches.
[[nodiscard]] bool fit_boxes(std::span<const WorldBox> boxes, std::span<const WorldBox> around, BoxLattice& lattice);

}  // namespace espalier::baker
