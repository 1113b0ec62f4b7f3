// What deformable blobs exclude, and the poses that they are given.
#pragma once

#include <optional>

#include <espalier/bake.hpp>

#include <baker/base/expected.hpp>
#include <baker/input/source.hpp>

namespace espalier::baker {

/// Returns a refusal if options exclude a deformable blob; nothing without BakeOptions::deformation.
[[nodiscard]] std::optional<Refusal> check_deformation(const BakeOptions& options);

/// Returns a refusal if there is no triangle, if a position is not finite, or if a pose has another number of them.
[[nodiscard]] std::optional<Refusal> check_poses(const Source& source, const Deformation& deformation);

}  // namespace espalier::baker
