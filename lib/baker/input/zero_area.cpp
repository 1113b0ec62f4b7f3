#include <baker/input/zero_area.hpp>

#include <array>
#include <cmath>

namespace espalier::baker {

namespace {

/// Whether twelve doubles add up to exactly zero. The running sum is kept as a non-overlapping expansion, to which each
/// two-sum step adds without loss (Shewchuk 1997, "Adaptive precision floating-point arithmetic", Grow-Expansion).
bool sum_is_zero(const std::array<double, 12>& terms) {
    std::array<double, 12> expansion{};
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
/// sum of six products, each of them of two doubles: its rounded value and what that lost, which a fused multiplication
/// gives. Coordinates are 0 or between 2^-200 and 2^128, so that nothing underflows.
bool component_is_zero(double a0, double a1, double b0, double b1, double c0, double c1) {
    const double left = (b0 - a0) * (c1 - a1);
    const double right = (b1 - a1) * (c0 - a0);
    if (left == 0.0 && right == 0.0) return true;
    if (std::abs(left - right) > 0x1p-49 * (std::abs(left) + std::abs(right))) return false;
    std::array<double, 12> terms;
    std::size_t count = 0;
    const auto add = [&](double x, double y) {
        const double product = x * y;
        terms[count++] = product;
        terms[count++] = std::fma(x, y, -product);
    };
    add(b0, c1);
    add(-b0, a1);
    add(-a0, c1);
    add(-b1, c0);
    add(b1, a0);
    add(a1, c0);
    return sum_is_zero(terms);
}

}  // namespace

bool has_zero_area(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return component_is_zero(a.x, a.y, b.x, b.y, c.x, c.y) && component_is_zero(a.y, a.z, b.y, b.z, c.y, c.z) &&
           component_is_zero(a.z, a.x, b.z, b.x, c.z, c.x);
}

}  // namespace espalier::baker
