// Where the bounds of the whole asset lie in a blob that has them, and the rotation of the oriented box.
#pragma once

#include <espalier/blob.hpp>
#include <runtime/base/bits.hpp>

namespace espalier::detail {

/// Returns where the bounds of a feature lie, or null when there are none.
inline const std::byte* stored_bounds(const BlobData& blob, std::uint32_t feature) {
    if ((blob.features & feature) == 0) return nullptr;
    return blob.bounds + format::bounds::bytes(blob.features & format::feature::bounds & (feature - 1));
}

/// A rotation times `norm`, exactly: the rows are perpendicular and of length `norm`. Entries are within +-norm, which
/// is below 2^24.
struct IntegerRotation {
    std::int32_t row[3][3];
    std::int32_t norm;
};

/// Returns the rotation of a quaternion whose parts are within +-format::bounds::max_quaternion.
constexpr IntegerRotation rotation_of(std::int32_t w, std::int32_t x, std::int32_t y, std::int32_t z) {
    return {{{w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)},
             {2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)},
             {2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z}},
            w * w + x * x + y * y + z * z};
}
static_assert(4 * format::bounds::max_quaternion * format::bounds::max_quaternion < 1 << 24);

inline IntegerRotation stored_rotation(const std::byte* oriented_box) {
    const auto part = [&](std::size_t k) {
        return std::int32_t{load_i16(oriented_box + format::bounds::quaternion_at + 2 * k)};
    };
    return rotation_of(part(0), part(1), part(2), part(3));
}

}  // namespace espalier::detail
