// The refits that cost is measured with: a cloth whose blob lies in flash, in poses that rise and fall.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/deformation.hpp>

#include "../platform/fingerprint.hpp"
#include "measured_kinds.hpp"

namespace espalier::firmware {

/// Where the corners of a square cloth are: functions of their number and the step, in whole numbers.
class ClothPlaces {
public:
    static constexpr std::uint32_t side = 16;  ///< cells
    static constexpr std::uint32_t count = (side + 1) * (side + 1);
    static constexpr std::uint32_t triangles = 2 * side * side;

    /// Returns a place in range(). At step 0 the cloth is flat.
    static Vec3 at(std::uint32_t number, std::uint32_t step) {
        const std::uint32_t column = number % (side + 1), row = number / (side + 1);
        const std::uint32_t phase = (column + 2 * row + 3 * step) % 32;
        const std::uint32_t rise = phase < 16 ? phase : 32 - phase;
        const auto height = static_cast<float>(rise * (step % 8)) * 0.03125f;
        return {static_cast<float>(column), static_cast<float>(row) - 0.25f * height, height};
    }
    static Box range() { return {{-1.0f, -2.0f, -1.0f}, {side, side, 4.0f}}; }
};

/// deformable_bytes() of the cloth is at most this, with 16 bits.
inline constexpr std::size_t most_cloth_bytes = 5'000;

/// Refits a cloth; `measure(kind, call)` runs each refit. The bytes of each pose go into the fingerprint.
template <class Measure>
class RefitWorkload {
public:
    RefitWorkload(std::span<std::byte> memory, std::span<Vec3> positions, const Blob& cloth, const Measure& measure)
        : memory_(memory.first(deformable_bytes(cloth))),
          positions_(positions),
          mesh_(create_deformable(cloth, memory_)),
          measure_(measure) {}

    void ask(std::uint32_t steps) {
        for (std::uint32_t step = 1; step <= steps; ++step) {
            for (std::uint32_t i = 0; i < positions_.size(); ++i) positions_[i] = ClothPlaces::at(i, step);
            RefitResult result;
            measure_("refit", [&] { result = refit(mesh_, positions_); });
            answers_.add(static_cast<std::uint32_t>(result.status), result.quality,
                         std::span<const std::byte>(memory_));
        }
    }
    [[nodiscard]] const platform::Fingerprint& answers() const { return answers_; }

private:
    std::span<std::byte> memory_;
    std::span<Vec3> positions_;
    Deformable mesh_;
    const Measure& measure_;
    platform::Fingerprint answers_;
};

}  // namespace espalier::firmware
