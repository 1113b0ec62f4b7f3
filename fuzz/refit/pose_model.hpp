// What refit() must return and store, computed in double from the independent decoder's words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <espalier/deformation.hpp>

#include "support/format/decoder.hpp"

namespace espalier::fuzz {

class PoseModel {
public:
    explicit PoseModel(const tests::DecodedBlob& blob) : blob_(blob) {}

    /// Returns the position at a lattice point, rounded to float.
    [[nodiscard]] Vec3 position_at(const tests::GridPoint& point) const;
    /// Returns positions that have the blob in its pose; those without a triangle lie at the origin of the lattice.
    /// Nothing if a float cannot hold one of them, or if a position is at two places.
    [[nodiscard]] std::optional<std::vector<Vec3>> positions_of_pose() const;
    /// Returns the status and the position that refit() must return.
    [[nodiscard]] RefitResult result_of(std::span<const Vec3> positions) const;
    /// Ends the program if a sealed blob does not hold the positions, which are in range.
    void check(const tests::DecodedBlob& sealed, std::span<const Vec3> positions) const;

private:
    /// Returns nothing out of range.
    [[nodiscard]] std::optional<std::int32_t> coordinate(float position, std::size_t axis) const;
    [[nodiscard]] std::optional<tests::GridPoint> point_at(const Vec3& position) const;

    const tests::DecodedBlob& blob_;
};

}  // namespace espalier::fuzz
