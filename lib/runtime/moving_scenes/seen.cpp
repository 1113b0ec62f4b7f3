// Views of a moving scene from places in its world. Float64 is read and written by its bits: small cores have no
// arithmetic for it.
#include <array>

#include <runtime/moving_scenes/access.hpp>

namespace espalier {

using namespace detail;

namespace {

constexpr int fraction_bits = 52;
constexpr std::uint64_t leading_bit = std::uint64_t{1} << fraction_bits;
constexpr std::int32_t exponent_bias = 1023;
/// 2^grid_exponent(e) is the distance of two origins.
constexpr std::int32_t grid_exponent(std::int32_t step_exponent) { return step_exponent + 7; }

/// Finds the nearest origin to a coordinate, which is given by its bits, in steps. False if that is not in the world,
/// or the coordinate is no number.
bool find_origin(std::uint64_t bits, std::int32_t step_exponent, std::int32_t& origin) {
    const std::int32_t exponent = static_cast<std::int32_t>(bits >> fraction_bits & 0x7FFu) - exponent_bias;
    // The coordinate is mantissa * 2^-shift in units of the grid.
    const std::uint64_t mantissa = (bits & (leading_bit - 1)) | leading_bit;
    const std::int32_t shift = fraction_bits - exponent + grid_exponent(step_exponent);
    origin = 0;
    if (shift > fraction_bits + 1) return true;
    if (shift < 29) return false;  // 2^23 units and more
    const auto units = static_cast<std::int32_t>(((mantissa >> (shift - 1)) + 1) >> 1);
    if (units > most_world_steps / origin_grid) return false;
    origin = (bits >> 63 != 0 ? -units : units) * origin_grid;
    return true;
}

/// Returns the bits of an origin's coordinate.
std::uint64_t coordinate_of(std::int32_t origin, std::int32_t step_exponent) {
    if (origin == 0) return 0;
    const auto units = static_cast<std::uint64_t>(origin < 0 ? -origin : origin) / origin_grid;
    const std::int32_t length = static_cast<std::int32_t>(std::bit_width(units)) - 1;
    const auto exponent = static_cast<std::uint64_t>(exponent_bias + length + grid_exponent(step_exponent));
    const std::uint64_t fraction = (units << (fraction_bits - length)) & (leading_bit - 1);
    return std::uint64_t{origin < 0} << 63 | exponent << fraction_bits | fraction;
}

}  // namespace

MovingScene seen_from(const MovingScene& scene, const Vec3d& place) noexcept {
    if (!scene) return {};
    const std::int32_t step_exponent = scene.step_exponent();
    const auto coordinates = std::bit_cast<std::array<std::uint64_t, 3>>(place);
    std::int32_t origin[3];
    for (std::size_t k = 0; k < 3; ++k)
        if (!find_origin(coordinates[k], step_exponent, origin[k])) return {};
    return MovingSceneAccess::with_origin(scene, origin);
}

Vec3d MovingScene::origin() const noexcept {
    if (block_ == nullptr) return {};
    const std::int32_t exponent = step_exponent();
    const std::array coordinates = {coordinate_of(origin_[0], exponent), coordinate_of(origin_[1], exponent),
                                    coordinate_of(origin_[2], exponent)};
    return std::bit_cast<Vec3d>(coordinates);
}

}  // namespace espalier
