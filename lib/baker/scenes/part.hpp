// What instances of a scene place: meshes and tiles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <espalier/scene.hpp>

#include <baker/base/expected.hpp>

namespace espalier::baker {

/// An open mesh or an open tile. It refers to its bytes, which must outlive it.
class ScenePart {
public:
    explicit ScenePart(const Blob& mesh) : mesh_(mesh) {}
    explicit ScenePart(const BakedScene& tile) : tile_(tile) {}
    /// Opens a blob, or a scene without tiles.
    [[nodiscard]] static Expected<ScenePart> open(std::span<const std::byte> bytes);

    [[nodiscard]] bool is_tile() const { return static_cast<bool>(tile_); }
    [[nodiscard]] std::span<const std::byte> bytes() const { return {tree().bytes, tree().size}; }
    /// Returns the number of meshes in a tile, 0 for a mesh.
    [[nodiscard]] std::uint32_t meshes_in_tile() const { return static_cast<std::uint32_t>(tile_.meshes().size()); }
    /// Returns the number of triangles, in a tile those of all instances.
    [[nodiscard]] std::uint64_t triangle_count() const;
    /// Returns the nodes and the lattice, in a tile those of the tree over its instances.
    [[nodiscard]] const detail::BlobData& tree() const {
        return is_tile() ? detail::data_of(tile_).tree : detail::data_of(mesh_);
    }
    /// Returns the lattice on which the corners lie, if there are any: in a tile the common lattice of instances.
    [[nodiscard]] std::optional<espalier::Lattice> lattice() const;
    /// Returns where the local origin lies in the source.
    [[nodiscard]] Vec3d source_origin() const { return is_tile() ? tile_.source_origin() : mesh_.source_origin(); }
    /// Returns the step of the lattice, in a tile the finest one of its instances; infinite without triangles.
    [[nodiscard]] double finest_step() const;
    /// Returns a bound on the distance between the surface and its source at a place that was moved by rounding, in
    /// world units.
    [[nodiscard]] float error_at(const Transform& transform, double moved) const;
    /// Returns what verify() or verify_scene() finds wrong.
    [[nodiscard]] std::optional<std::string> find_fault() const;

private:
    Blob mesh_;
    BakedScene tile_;
    std::vector<Blob> meshes_;  ///< of the tile, if open() has opened them
};

}  // namespace espalier::baker
