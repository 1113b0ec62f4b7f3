// Whether a feature of a triangle only joins it with others of one surface.
#pragma once

#include <espalier/contact.hpp>

namespace espalier::detail {

/// Returns whether the feature is a flat or concave edge, or a corner between two such edges of the triangle. Returns
/// false for a face, without edge flags, and for a triangle that the blob does not have.
[[nodiscard]] bool is_internal(const Blob& blob, TriangleId triangle, Feature feature) noexcept;

}  // namespace espalier::detail
