// What a blob carries only on request, computed from the mesh on its lattice: edge flags and bounds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/blob.hpp>

#include <baker/collapse/order.hpp>
#include <baker/quantise/lattice_mesh.hpp>
#include <baker/sections/edge_flags.hpp>
#include <baker/sections/fit_bounds.hpp>

namespace espalier::baker {

struct OptionalSections {
    std::uint32_t features = 0;
    std::uint32_t flat_limit = 0;
    std::vector<EdgeFlags> edge_flags;  ///< of each triangle of the mesh
    FittedBox box;
    FittedSphere sphere;
    FittedKDop k_dop;
};

/// Nothing for an empty mesh.
[[nodiscard]] OptionalSections make_optional_sections(const LatticeMesh& mesh, const BakeOptions& options);

/// Appends the sections to a blob that holds all others.
void put_optional_sections(std::vector<std::byte>& blob, const OptionalSections& sections, const WideTree& wide);

/// Returns the volumes in world units; zero for bounds that are not stored.
[[nodiscard]] BoundsVolumes volumes_of(const OptionalSections& sections, const LatticeMesh& mesh);

/// Returns nothing, or the fault of a blob's sections: each flag must equal that of `edge_flags_of`, and all bounds
/// must hold all vertices. `mesh` is the blob's, with storage indices as original ids and corners in the blob's order.
[[nodiscard]] std::optional<std::string> check_optional_sections(const Blob& blob, const LatticeMesh& mesh);

}  // namespace espalier::baker
