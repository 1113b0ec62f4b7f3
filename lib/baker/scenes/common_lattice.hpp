// The lattice that instances share which are moved by whole steps: the pieces of a ground.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <espalier/scene.hpp>

namespace espalier::baker {

/// A region, and the instances that lie on its lattice and in it.
struct CommonLattice {
    espalier::Lattice region;
    std::uint32_t instances = 0;
};

/// Returns the region around the instances that are moved by whole steps and do not rotate or scale: of those with the
/// step that most of them have. None if there are none, or if they lie farther apart than a region reaches.
/// lattices[i] is that of the mesh or the tile of instance i, none without triangles.
[[nodiscard]] std::optional<CommonLattice> find_common_lattice(
    std::span<const Instance> instances, std::span<const std::optional<espalier::Lattice>> lattices);

}  // namespace espalier::baker
