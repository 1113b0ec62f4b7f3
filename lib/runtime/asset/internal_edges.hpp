// Whether a feature of a triangle only joins it with others of one surface.
#pragma once

#include <cstdint>

#include <espalier/contact.hpp>

namespace espalier::detail {

/// A bit for each Feature of a triangle that is internal as seen from a side: an edge that is flat or a valley there,
/// or a corner between two such edges of the triangle. From both sides that is what is flat.
struct InternalFeatures {
    std::uint8_t from_front = 0;
    std::uint8_t from_back = 0;

    [[nodiscard]] bool have(Feature feature, bool seen_from_back) const {
        const auto part = static_cast<unsigned>(feature);
        return part < 8 && (unsigned{seen_from_back ? from_back : from_front} >> part & 1u) != 0;
    }
};

/// Returns none without edge flags, and for a triangle that the blob does not have. Cost: O(1).
[[nodiscard]] InternalFeatures internal_features(const Blob& blob, TriangleId triangle) noexcept;

}  // namespace espalier::detail
