#include <runtime/overlap/bounding_plane.hpp>

namespace espalier::detail {

LatticePlane bounding_plane(const Support& support, int fraction_bits) noexcept {
    const Int128 coordinate[3] = {support.normal.x, support.normal.y, support.normal.z};
    int length = 0;
    for (const Int128& c : coordinate) {
        const int bits = Unsigned256(magnitude(c)).bit_length();
        length = bits > length ? bits : length;
    }
    const int shift = length > 23 ? length - 23 : 0;
    LatticePlane plane;
    const std::int64_t at[3] = {support.at.x, support.at.y, support.at.z};
    std::int64_t offset = static_cast<std::int64_t>((support.reach >> shift).low) + 1 + support.size;
    for (int k = 0; k < 3; ++k) {
        plane.normal[k] = static_cast<std::int32_t>((coordinate[k] >> shift).low);
        offset += plane.normal[k] * at[k];
    }
    plane.offset = offset >> fraction_bits;
    return plane;
}

}  // namespace espalier::detail
