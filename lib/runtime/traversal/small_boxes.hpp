// Boxes that are small enough to be taken for the surface in them.
#pragma once

#include <bit>
#include <cstdint>

#include <runtime/kernels/ray_triangle.hpp>
#include <runtime/lattice/round_point.hpp>
#include <runtime/lattice/round_ray.hpp>
#include <runtime/traversal/box_nodes.hpp>

namespace espalier::detail {

/// An accuracy as the largest whole number of lattice steps in it; negative when boxes shall not do.
inline std::int32_t steps_in(const BlobData& blob, float accuracy) {
    if (!(accuracy > 0.0f)) return -1;
    const float steps = scale_by_power_of_two(accuracy, -blob.step_exponent);
    // mutant(< -> <=) equivalent: both sides are equal then
    return steps < static_cast<float>(bounds_limit) ? static_cast<std::int32_t>(steps) : bounds_limit;
}

/// The squared distance from the point to the farthest point of a child's box, within 5 roundings.
template <class Node>
inline float farthest_squared(const Node& node, unsigned bits, unsigned child, const RoundedPoint& point) {
    float sum = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const float to_low = absolute(static_cast<float>(node.low(k, child, bits)) - point.steps[k]);
        const float to_high = absolute(static_cast<float>(node.high(k, child, bits)) - point.steps[k]);
        const float far = maximum(to_low, to_high);
        sum += far * far;
    }
    return sum;
}

/// Whether the ray passes through a box of whole lattice steps within its window, exactly: what lanes say depends on
/// the machine.
ESPALIER_NOINLINE inline bool passes_through(const IntegerRay& ray, const std::int32_t* low, const std::int32_t* high) {
    // Where the ray enters and leaves along each axis, as fractions: numerators in units of 2^-fraction_bits steps,
    // below 2^33, over the direction's magnitude, which is not 0 and below 2^25.
    std::int64_t enter[3], leave[3], length[3];
    for (int k = 0; k < 3; ++k) {
        const std::int64_t from = (std::int64_t{low[k]} << ray.fraction_bits) - ray.origin[k];
        const std::int64_t to = (std::int64_t{high[k]} << ray.fraction_bits) - ray.origin[k];
        // mutant(< -> <=) equivalent: an axis with direction 0 is left out, whichever end comes first
        const bool is_down = ray.direction[k] < 0;
        length[k] = is_down ? -std::int64_t{ray.direction[k]} : std::int64_t{ray.direction[k]};
        // mutant(without 4) equivalent: a box behind the origin along this axis fails a comparison below
        if (length[k] == 0 && (from > 0 || to < 0)) return false;
        enter[k] = is_down ? -to : from;
        leave[k] = is_down ? -from : to;
    }
    const auto is_within_window = [&](int k) {
        const Int128 denominator = Int128(length[k]) << ray.fraction_bits;
        if (leave[k] < 0 ||
            (ray.tau_min > 0.0f && ray_triangle::compare_quotient(Int128(leave[k]), denominator, ray.tau_min) < 0))
            return false;
        // mutant(without 2) equivalent: the comparison takes infinity for 2^128, and no entry is that late
        if (enter[k] <= 0 || ray.tau_max == infinity) return true;
        // mutant(without 1, > -> >=) equivalent: the comparison takes 0 for 2^-127, and no later entry is that early
        return ray.tau_max > 0.0f && ray_triangle::compare_quotient(Int128(enter[k]), denominator, ray.tau_max) <= 0;
    };
    for (int k = 0; k < 3; ++k) {
        // mutant(never) equivalent: an axis with direction 0 passes every comparison below
        if (length[k] == 0) continue;
        if (!is_within_window(k)) return false;
        for (int j = 0; j < 3; ++j)  // where the ray does not run nothing is left before it is entered
            if (enter[k] * length[j] > leave[j] * length[k]) return false;
    }
    return true;
}

/// Returns whether the ray passes through the box of a child, exactly.
template <class Node>
inline bool passes_through(const IntegerRay& ray, const Node& node, unsigned bits, unsigned child) {
    std::int32_t low[3], high[3];
    for (int k = 0; k < 3; ++k) {
        low[k] = node.low(k, child, bits);
        high[k] = node.high(k, child, bits);
    }
    return passes_through(ray, low, high);
}
/// Returns those of the children.
template <class Node>
inline unsigned children_passed(const IntegerRay& ray, const Node& node, unsigned bits, unsigned children) {
    unsigned passed = 0;
    for (; children != 0; children &= children - 1) {
        const auto child = static_cast<unsigned>(std::countr_zero(children));
        if (passes_through(ray, node, bits, child)) passed |= 1u << child;
    }
    return passed;
}

/// Returns whether the ray passes through the asset's box and every box on the way to a node. A box may stick out of
/// those above it, and whether lanes let a ray just beside one of those through depends on the machine.
template <class Node>
ESPALIER_NOINLINE bool passes_down_to(const IntegerRay& ray, const BlobData& blob, const Node& target) {
    constexpr std::int32_t low[3] = {0, 0, 0};
    if (!passes_through(ray, low, blob.extent)) return false;
    // mutant(- -> +) equivalent: pointers cannot be added, so the mutant is the original
    const auto index = static_cast<std::uint32_t>(static_cast<std::size_t>(target.bytes - blob.nodes) / Node::size);
    Node node = node_at<Node>(blob, 0);
    // mutant(without 2, < -> <=) equivalent: in an opened blob the way down ends earlier; this guards bytes that were
    // not opened
    for (unsigned depth = 0; node.bytes != target.bytes && depth < format::max_depth; ++depth) {
        const std::uint32_t first = node.first_child();
        unsigned child = 0;
        if (index - first < node.node_children()) {
            child = index - first;
        } else {
            // Depth first: what is below a node begins with its first child and ends before what is below the next one.
            for (unsigned each = 0; each < node.node_children(); ++each) {
                const std::uint32_t begin = node_at<Node>(blob, first + each).first_child();
                if (begin != 0 && begin <= index) child = each;
            }
        }
        if (!passes_through(ray, node, blob.bits, child)) return false;
        node = node_at<Node>(blob, first + child);
    }
    return true;
}

}  // namespace espalier::detail
