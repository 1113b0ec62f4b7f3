// First stage: checks everything that an importer delivers.
#pragma once

#include <optional>
#include <span>

#include <espalier/bake.hpp>

#include <baker/base/expected.hpp>
#include <baker/input/source.hpp>

namespace espalier::baker {

/// Returns a refusal for options that are out of their range.
[[nodiscard]] std::optional<Refusal> check_options(const BakeOptions& options);

/// Concatenates the meshes, and subtracts the origin from their positions. Broken triangles are refused, or with
/// drop_bad_triangles dropped and counted in the report. Triangles without area are set aside and counted.
Expected<Source> check_input(std::span<const MeshView> meshes, const Vec3d& origin, const BakeOptions& options,
                             BakeReport& report);

}  // namespace espalier::baker
