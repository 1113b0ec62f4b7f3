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

/// The boxes of the nodes in the upper levels of a mesh or a tile, which together contain it: placed one by one they
/// leave less room around it than its own box does.
class PartBoxes {
public:
    explicit PartBoxes(const ScenePart& part);

    /// Returns a box that contains the part at that place, however its corners are rounded on the way to the world. For
    /// a part without triangles it is the place of the local origin.
    [[nodiscard]] WorldBox at(const Transform& transform) const;
    /// Returns a box that contains the part's whole lattice at that place, and the local origin.
    [[nodiscard]] WorldBox lattice_at(const Transform& transform) const;

private:
    /// A box in local space.
    struct LocalBox {
        std::array<double, 3> center;
        std::array<double, 3> half;
    };

    static LocalBox local_box(const detail::BlobData& tree, const DecodedBox& box);
    static WorldBox place(std::span<const LocalBox> boxes, const Transform& transform);

    std::vector<LocalBox> boxes_;
    std::vector<LocalBox> lattice_;  ///< one, or none without triangles
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
