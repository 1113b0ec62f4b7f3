// The coordinates of a vector, computed side by side in one register. Each operation is that of the single coordinates,
// with the same bits.
#pragma once

#include <bit>
#include <cstdint>

#include <espalier/types.hpp>
#include <runtime/base/bits.hpp>

namespace espalier::detail {

/// Three floats in a vector of four; the fourth has any value.
class Coordinates {
    using Values = float __attribute__((vector_size(16)));
    using Words = std::int32_t __attribute__((vector_size(16)));
    [[gnu::always_inline]] explicit Coordinates(Values values) : values_(values) {}

public:
    [[gnu::always_inline]] Coordinates(float x, float y, float z) : values_{x, y, z, z} {}

    [[gnu::always_inline]] friend Coordinates operator+(const Coordinates& a, const Coordinates& b) {
        return Coordinates(a.values_ + b.values_);
    }
    [[gnu::always_inline]] friend Coordinates operator-(const Coordinates& a, const Coordinates& b) {
        return Coordinates(a.values_ - b.values_);
    }
    [[gnu::always_inline]] friend Coordinates operator*(const Coordinates& a, const Coordinates& b) {
        return Coordinates(a.values_ * b.values_);
    }
    [[gnu::always_inline]] friend Coordinates operator/(const Coordinates& a, const Coordinates& b) {
        return Coordinates(a.values_ / b.values_);
    }
    /// Returns the coordinates, those whose magnitudes have lower bits as zero.
    [[gnu::always_inline]] friend Coordinates without_below(const Coordinates& a, std::uint32_t least) {
        const Words bits = std::bit_cast<Words>(a.values_);
        const Words is_below = (bits & 0x7FFFFFFF) < static_cast<std::int32_t>(least);
        const Words kept = bits & ~is_below;
        return Coordinates(std::bit_cast<Values>(kept));
    }
    /// Returns one coordinate of the first, one of the second and one of the third.
    template <int x, int y, int z>
    [[gnu::always_inline]] static Coordinates picked(const Coordinates& a, const Coordinates& b, const Coordinates& c) {
        const Values two = __builtin_shufflevector(a.values_, b.values_, x, x, 4 + y, 4 + y);
        return Coordinates(__builtin_shufflevector(two, c.values_, 0, 2, 4 + z, 4 + z));
    }
    /// Returns the coordinates in another order, or some of them several times.
    template <int x, int y, int z>
    [[nodiscard, gnu::always_inline]] Coordinates in_order() const {
        return Coordinates(__builtin_shufflevector(values_, values_, x, y, z, z));
    }
    [[gnu::always_inline]] explicit Coordinates(float all) : Coordinates(all, all, all) {}
    [[gnu::always_inline]] explicit Coordinates(const Vec3& v) : Coordinates(v.x, v.y, v.z) {}

    [[gnu::always_inline]] float operator[](int k) const { return values_[k]; }
    [[nodiscard, gnu::always_inline]] Vec3 vector() const { return {values_[0], values_[1], values_[2]}; }

private:
    Values values_;
};

}  // namespace espalier::detail
