// Between local space and the lattice: exactly, in integers, so that no core needs floats for it.
#include <espalier/advanced/lattice.hpp>
#include <runtime/lattice/rounder.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Returns whether a lattice is in the range of those of blobs, so that nothing overflows.
bool is_lattice(const Lattice& lattice) {
    return lattice.step_exponent >= format::min_step_exponent && lattice.step_exponent <= format::max_step_exponent &&
           detail::is_finite(lattice.origin);
}

/// Orders like the number, subnormal ones as zero; for what is no NaN.
std::int32_t order_of(float x) {
    const auto magnitude = static_cast<std::int32_t>(magnitude_bits(x));
    return magnitude < 0x00800000 ? 0 : is_negative(x) ? -magnitude : magnitude;
}

/// A coordinate in units of 2^-fine_bits steps, rounded down.
struct FineSteps {
    static constexpr int fine_bits = 40;
    Int128 units = 0;
    bool is_exact = true;
};

/// False beyond 2^80 steps.
bool to_fine_steps(float local, int step_exponent, FineSteps& fine) {
    if (order_of(local) == 0) return true;
    const int shift = exponent_of(local) - 23 - step_exponent + FineSteps::fine_bits;
    if (shift > 80 + FineSteps::fine_bits - 23) return false;
    const auto mantissa = static_cast<std::int64_t>((magnitude_bits(local) & 0x007FFFFFu) | 0x00800000u);
    const Int128 whole = is_negative(local) ? -mantissa : mantissa;
    if (shift >= 0) {
        fine.units = shift < 64 ? whole << shift : (whole << 63) << (shift - 63);
    } else {
        fine.units = whole >> (shift < -64 ? 64 : -shift);
        fine.is_exact = shift > -24 && (mantissa & ((std::int64_t{1} << -shift) - 1)) == 0;
    }
    return true;
}

/// The difference of two numbers in steps plus `halves` / 2, rounded down; `halves` is 0 or 1. False beyond
/// max_lattice_coordinate.
bool floor_steps(float from, float to, int step_exponent, int halves, std::int32_t& steps) {
    if (order_of(from) == order_of(to)) {  // however far away
        steps = 0;
        return true;
    }
    FineSteps low, high;
    if (!to_fine_steps(from, step_exponent, low) || !to_fine_steps(to, step_exponent, high)) return false;
    Int128 units = high.units - low.units + (Int128(halves) << (FineSteps::fine_bits - 1));
    // Both rounded down: a difference that comes out whole may be a little less. What is not exact is tiny, so that
    // when neither is the floats themselves can be compared: their difference came out as 0 or by one unit too much.
    const bool may_be_less = !low.is_exact && (high.is_exact || order_of(to) < order_of(from));
    if (may_be_less) units = units - Int128(1);
    const Int128 whole = units >> FineSteps::fine_bits;
    if (whole < Int128(-max_lattice_coordinate) || Int128(max_lattice_coordinate) < whole) return false;
    steps = static_cast<std::int32_t>(static_cast<std::int64_t>(whole.low));
    return true;
}

}  // namespace

Result<LatticePoint> to_lattice(const Lattice& lattice, const Vec3& local) noexcept {
    if (!is_lattice(lattice) || !detail::is_finite(local)) return {{}, QueryStatus::invalid_argument};
    LatticePoint nearest;
    const auto round = [&](float from, float to, std::int32_t& rounded) {
        return floor_steps(from, to, lattice.step_exponent, 1, rounded);
    };
    if (!round(lattice.origin.x, local.x, nearest.x) || !round(lattice.origin.y, local.y, nearest.y) ||
        !round(lattice.origin.z, local.z, nearest.z))
        return {{}, QueryStatus::out_of_range};
    return {nearest, QueryStatus::ok};
}

Result<LatticeBox> to_lattice(const Lattice& lattice, const Box& local) noexcept {
    if (!is_lattice(lattice) || !detail::is_finite(local.min) || !detail::is_finite(local.max))
        return {{}, QueryStatus::invalid_argument};
    LatticeBox around;
    bool is_empty = false;
    const auto enclose = [&](float origin, float min, float max, std::int32_t& low, std::int32_t& high) {
        is_empty |= order_of(min) > order_of(max);
        if (!floor_steps(origin, min, lattice.step_exponent, 0, low) ||
            !floor_steps(max, origin, lattice.step_exponent, 0, high))
            return false;
        high = -high;
        return true;
    };
    if (!enclose(lattice.origin.x, local.min.x, local.max.x, around.min.x, around.max.x) ||
        !enclose(lattice.origin.y, local.min.y, local.max.y, around.min.y, around.max.y) ||
        !enclose(lattice.origin.z, local.min.z, local.max.z, around.min.z, around.max.z))
        return {{}, QueryStatus::out_of_range};
    return {is_empty ? LatticeBox{{0, 0, 0}, {-1, -1, -1}} : around, QueryStatus::ok};
}

Vec3 to_local(const Lattice& lattice, const LatticePoint& steps) noexcept {
    // A step may be of any size here; by 2^1000 and more every number is the same.
    const int step = lattice.step_exponent;
    const int exponent = step > 1000 ? 1000 : step < -1000 ? -1000 : step;
    const auto coordinate = [&](float origin, std::int32_t number) {
        return flush_subnormal(origin + flush_subnormal(scale_by_power_of_two(static_cast<float>(number), exponent)));
    };
    return {coordinate(lattice.origin.x, steps.x), coordinate(lattice.origin.y, steps.y),
            coordinate(lattice.origin.z, steps.z)};
}

}  // namespace espalier
