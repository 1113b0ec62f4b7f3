// First stage: nothing that an importer delivers is believed.
#pragma once

#include <optional>
#include <span>

#include <espalier/bake.hpp>

#include <baker/input/source.hpp>

namespace espalier::baker {

/// Options out of their range.
[[nodiscard]] std::optional<BakeError> check_options(const BakeOptions& options);

/// Concatenates the meshes and sorts out what is broken: refused, or under repair dropped and counted in the report.
/// Triangles without area are set aside and counted.
[[nodiscard]] Result<Source, BakeError> check_input(std::span<const MeshView> meshes, const BakeOptions& options,
                                                    BakeReport& report);

}  // namespace espalier::baker
