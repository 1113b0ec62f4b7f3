// The positions of all meshes of an import in a row, by which the poses of deformable blobs match.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <espalier/import.hpp>
#include <espalier/types.hpp>

#include "exit_code.hpp"

namespace espalier::tools {

/// Returns them less an origin, as the float32 numbers that poses consist of.
std::vector<Vec3> positions_in_a_row(const ImportResult& imported, const Vec3d& origin);

/// Returns the number of the first position in the row with a coordinate that is NaN or infinite.
std::optional<std::size_t> first_not_finite(const std::vector<Vec3>& positions);

/// Returns the first coordinate that is not finite, "x = NaN".
std::string words_for_not_finite(Vec3 position);

/// Throws CommandError (invalid_input): "pose.obj, mesh 0, vertex 17 PROBLEM". `position` is the number in the row, and
/// `kind` that of ErrorDetails.
[[noreturn]] void refuse_position(const ImportResult& imported, std::size_t position, const std::string& problem,
                                  const std::string& kind = {});

}  // namespace espalier::tools
