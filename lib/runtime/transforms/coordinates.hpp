// The coordinates of a vector, computed side by side: in one register, or on small cores by functions. Each operation
// is that of the single coordinates, with the same bits.
#pragma once

#include <bit>
#include <cstdint>

#include <espalier/types.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/base/options.hpp>
#include <runtime/base/vector.hpp>

namespace espalier::detail {

#if ESPALIER_SMALL_CODE

/// Three floats.
class Coordinates {
    float values_[3];

    Coordinates() = default;
    template <class Compute>
    ESPALIER_ALWAYS_INLINE static Coordinates of_each(Compute compute) {
        Coordinates result;
        for (int k = 0; k < 3; ++k) result.values_[k] = compute(k);
        return result;
    }

public:
    /// Written out, so that compilers pass and return it in memory.
    Coordinates(const Coordinates& other) : values_{other[0], other[1], other[2]} {}
    Coordinates(float x, float y, float z) : values_{x, y, z} {}
    explicit Coordinates(float all) : Coordinates(all, all, all) {}
    explicit Coordinates(const Vec3& v) : Coordinates(v.x, v.y, v.z) {}

    ESPALIER_NOINLINE friend Coordinates operator+(const Coordinates& a, const Coordinates& b) {
        return of_each([&](int k) { return a[k] + b[k]; });
    }
    ESPALIER_NOINLINE friend Coordinates operator-(const Coordinates& a, const Coordinates& b) {
        return of_each([&](int k) { return a[k] - b[k]; });
    }
    ESPALIER_NOINLINE friend Coordinates operator*(const Coordinates& a, const Coordinates& b) {
        return of_each([&](int k) { return a[k] * b[k]; });
    }
    ESPALIER_NOINLINE friend Coordinates operator/(const Coordinates& a, const Coordinates& b) {
        return of_each([&](int k) { return a[k] / b[k]; });
    }
    ESPALIER_NOINLINE friend Coordinates without_below(const Coordinates& a, std::uint32_t least) {
        return of_each([&](int k) {
            const std::uint32_t bits = std::bit_cast<std::uint32_t>(a[k]);
            return (bits & 0x7FFFFFFFu) < least ? 0.0f : a[k];
        });
    }
    ESPALIER_NOINLINE friend Coordinates magnitude(const Coordinates& a) {
        return of_each([&](int k) { return absolute(a[k]); });
    }
    void store_whole_below(std::int32_t* to) const {
        for (int k = 0; k < 3; ++k) {
            const auto whole = static_cast<std::int32_t>(values_[k]);
            const bool is_below_zero = std::bit_cast<std::int32_t>(values_[k]) < 0;
            to[k] = static_cast<float>(whole) > values_[k] || (is_below_zero && whole == 0) ? whole - 1 : whole;
        }
    }
    friend bool are_at_least(const Coordinates& a, const Coordinates& b, float least) {
        for (int k = 0; k < 3; ++k)
            if (!(a[k] >= least && b[k] >= least)) return false;
        return true;
    }
    template <int x, int y, int z>
    static Coordinates picked(const Coordinates& a, const Coordinates& b, const Coordinates& c) {
        return {a[x], b[y], c[z]};
    }
    template <int x, int y, int z>
    [[nodiscard]] Coordinates in_order() const {
        return {values_[x], values_[y], values_[z]};
    }
    float operator[](int k) const { return values_[k]; }
    [[nodiscard]] Vec3 vector() const { return {values_[0], values_[1], values_[2]}; }
};

#else

/// Three floats in a vector of four; the fourth has any value.
class Coordinates {
    using Values = Vector<float, 4>;
    using Words = Vector<std::int32_t, 4>;
    ESPALIER_ALWAYS_INLINE explicit Coordinates(Values values) : values_(values) {}

public:
    ESPALIER_ALWAYS_INLINE Coordinates(float x, float y, float z) : values_{x, y, z, z} {}

    ESPALIER_ALWAYS_INLINE friend Coordinates operator+(const Coordinates& a, const Coordinates& b) {
        return Coordinates(a.values_ + b.values_);
    }
    ESPALIER_ALWAYS_INLINE friend Coordinates operator-(const Coordinates& a, const Coordinates& b) {
        return Coordinates(a.values_ - b.values_);
    }
    ESPALIER_ALWAYS_INLINE friend Coordinates operator*(const Coordinates& a, const Coordinates& b) {
        return Coordinates(a.values_ * b.values_);
    }
    ESPALIER_ALWAYS_INLINE friend Coordinates operator/(const Coordinates& a, const Coordinates& b) {
        return Coordinates(a.values_ / b.values_);
    }
    /// Returns the coordinates, those whose magnitudes have lower bits as zero.
    ESPALIER_ALWAYS_INLINE friend Coordinates without_below(const Coordinates& a, std::uint32_t least) {
        const Words bits = std::bit_cast<Words>(a.values_);
        const Words is_below = (bits & 0x7FFFFFFF) < static_cast<std::int32_t>(least);
        const Words kept = bits & ~is_below;
        return Coordinates(std::bit_cast<Values>(kept));
    }
    ESPALIER_ALWAYS_INLINE friend Coordinates magnitude(const Coordinates& a) {
        return Coordinates(std::bit_cast<Values>(std::bit_cast<Words>(a.values_) & 0x7FFFFFFF));
    }
    /// Writes the last whole number below each coordinate or at it; below a zero with a sign it is -1, as below a
    /// number that was flushed to it. Coordinates are at most 2^30 large.
    ESPALIER_ALWAYS_INLINE void store_whole_below(std::int32_t* to) const {
        const Words whole = ESPALIER_CONVERT_VECTOR(values_, Words);
        const Words is_above =
            (ESPALIER_CONVERT_VECTOR(whole, Values) > values_) | ((std::bit_cast<Words>(values_) < 0) & (whole == 0));
        const Words below = whole + is_above;
        ESPALIER_COPY_BYTES(to, &below, 3 * sizeof *to);
    }
    /// Returns whether no coordinate of either is below the least; false for NaN.
    ESPALIER_ALWAYS_INLINE friend bool are_at_least(const Coordinates& a, const Coordinates& b, float least) {
        const Values all = {least, least, least, least};
        const Words are = (a.values_ >= all) & (b.values_ >= all);
        return (are[0] & are[1] & are[2]) != 0;
    }
    /// Returns one coordinate of the first, one of the second and one of the third.
    template <int x, int y, int z>
    ESPALIER_ALWAYS_INLINE static Coordinates picked(const Coordinates& a, const Coordinates& b, const Coordinates& c) {
        const Values two = ESPALIER_SHUFFLE_VECTOR(a.values_, b.values_, x, x, 4 + y, 4 + y);
        return Coordinates(ESPALIER_SHUFFLE_VECTOR(two, c.values_, 0, 2, 4 + z, 4 + z));
    }
    /// Returns the coordinates in another order, or some of them several times.
    template <int x, int y, int z>
    [[nodiscard]] ESPALIER_ALWAYS_INLINE Coordinates in_order() const {
        return Coordinates(ESPALIER_SHUFFLE_VECTOR(values_, values_, x, y, z, z));
    }
    ESPALIER_ALWAYS_INLINE explicit Coordinates(float all) : Coordinates(all, all, all) {}
    ESPALIER_ALWAYS_INLINE explicit Coordinates(const Vec3& v) : Coordinates(v.x, v.y, v.z) {}

    ESPALIER_ALWAYS_INLINE float operator[](int k) const { return values_[k]; }
    [[nodiscard]] ESPALIER_ALWAYS_INLINE Vec3 vector() const { return {values_[0], values_[1], values_[2]}; }

private:
    Values values_;
};

#endif

}  // namespace espalier::detail
