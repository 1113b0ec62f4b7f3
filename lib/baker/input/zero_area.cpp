#include <baker/input/zero_area.hpp>

#include <array>
#include <cmath>

namespace espalier::baker {

namespace {

/// Whether six doubles add up to exactly zero. The running sum is kept as a non-overlapping expansion, to which each
/// two-sum step adds without loss (Shewchuk 1997, "Adaptive precision floating-point arithmetic", Grow-Expansion).
bool sum_is_zero(const std::array<double, 6>& terms) {
    std::array<double, 6> expansion{};
    for (std::size_t used = 0; used < terms.size(); ++used) {
        double carry = terms[used];
        for (std::size_t i = 0; i < used; ++i) {
            const double sum = carry + expansion[i];
            const double virtual_part = sum - carry;
            expansion[i] = (carry - (sum - virtual_part)) + (expansion[i] - virtual_part);
            carry = sum;
        }
        expansion[used] = carry;
    }
    for (const double component : expansion) {
        if (component != 0.0) return false;
    }
    return true;
}

/// Whether (b - a) x (c - a), projected to the axes 0 and 1, is exactly zero.
///
/// Rounded first: the two products of differences are each off by at most 4 * 2^-53 of themselves, so a difference that
/// exceeds 2^-49 of their sum cannot be zero. Otherwise exactly: written out, with a0 a1 cancelled, the component is a
/// sum of six products of two floats, each exact in a double (48 bits, exponents above -300).
bool component_is_zero(double a0, double a1, double b0, double b1, double c0, double c1) {
    const double left = (b0 - a0) * (c1 - a1);
    const double right = (b1 - a1) * (c0 - a0);
    if (std::abs(left - right) > 0x1p-49 * (std::abs(left) + std::abs(right))) return false;
    return sum_is_zero({b0 * c1, -(b0 * a1), -(a0 * c1), -(b1 * c0), b1 * a0, a1 * c0});
}

}  // namespace

bool has_zero_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    return component_is_zero(double(a.x), double(a.y), double(b.x), double(b.y), double(c.x), double(c.y)) &&
           component_is_zero(double(a.y), double(a.z), double(b.y), double(b.z), double(c.y), double(c.z)) &&
           component_is_zero(double(a.z), double(a.x), double(b.z), double(b.x), double(c.z), double(c.x));
}

}  // namespace espalier::baker
