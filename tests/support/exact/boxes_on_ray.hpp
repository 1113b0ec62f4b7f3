// Nodes in an asset, rays at their boxes, and whether one passes through a box by exact arithmetic.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <runtime/blob/node.hpp>
#include <runtime/lattice/round_ray.hpp>

#include "oracle/rational.hpp"
#include "support/queries/some_ray.hpp"

namespace espalier::tests {

using oracle::Rational;

/// A node with as many children as its kind holds.
template <class NodeKind>
struct FullNode {
    static constexpr unsigned children = NodeKind::max_children;
    static constexpr unsigned every_child = (1u << children) - 1;

    std::array<std::byte, NodeKind::size + 16> bytes{};
    NodeKind node{bytes.data()};

    FullNode() {
        if constexpr (is_packed) bytes[NodeKind::children_at + 3] = std::byte{0x80};
        else bytes[format::plain_node::leaf_children_at] = std::byte{16};
    }
    FullNode(const FullNode&) = delete;
    FullNode& operator=(const FullNode&) = delete;
    ~FullNode() = default;

    void set_base(std::size_t axis, std::uint32_t base) { put_word(format::packed_node::base_at + 2 * axis, base); }
    void set_shifts(std::array<unsigned, 3> shifts) {
        put_word(format::packed_node::shifts_at, shifts[0] | shifts[1] << 5 | shifts[2] << 10);
    }
    /// In planes.
    void set_box(std::size_t axis, unsigned child, unsigned low, unsigned high) {
        if constexpr (is_packed) {
            bytes[format::packed_node::lo_at + 8 * axis + child] = static_cast<std::byte>(low);
            bytes[format::packed_node::hi_at + 8 * axis + child] = static_cast<std::byte>(high);
        } else {
            put_word(format::plain_node::lo_at + 32 * axis + 2 * std::size_t{child}, low);
            put_word(format::plain_node::hi_at + 32 * axis + 2 * std::size_t{child}, high);
        }
    }

private:
    static constexpr bool is_packed = NodeKind::max_children == 8;

    void put_word(std::size_t at, unsigned word) {
        bytes[at] = static_cast<std::byte>(word);
        bytes[at + 1] = static_cast<std::byte>(word >> 8);
    }
};
using EightBoxes = FullNode<detail::PackedNode>;
using SixteenBoxes = FullNode<detail::PlainNode>;

/// Calls with each kind.
template <class Call>
void for_each_full_node(Call call) {
    call.template operator()<EightBoxes>();
    call.template operator()<SixteenBoxes>();
}

/// The boxes of one axis: of all sizes, flat ones and points among them, over so many planes.
template <class Boxes>
void set_boxes(Random& random, std::size_t axis, unsigned planes, Boxes& boxes) {
    for (unsigned child = 0; child < Boxes::children; ++child) {
        unsigned low = random.below(planes), high = random.below(planes);
        if (random.below(6) == 0) high = low;
        if (random.below(6) == 0) low = 0;
        if (random.below(6) == 0) high = planes - 1;
        boxes.set_box(axis, child, std::min(low, high), std::max(low, high));
    }
}

/// Boxes as a sound blob's, within the asset or less than one coarsest plane beyond; or anywhere.
inline void make_boxes(const detail::BlobData& asset, Random& random, bool within, EightBoxes& boxes) {
    const unsigned unit = asset.bits > 16 ? asset.bits - 16u : 0u;
    std::array<unsigned, 3> shifts{};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto extent = static_cast<std::uint32_t>(asset.extent[k]);
        unsigned coarsest = 0;
        while (255u << coarsest < extent) ++coarsest;
        shifts[k] = random.below((within ? coarsest : format::packed_node::max_shift) + 1);
        const std::uint32_t base = within ? random.below((extent >> unit) + 1) : random.below(1u << 16);
        boxes.set_base(k, base);
        const std::uint32_t room = extent + (1u << coarsest) - 1 - (base << unit);
        set_boxes(random, k, within ? std::min(room >> shifts[k], 255u) + 1 : 256, boxes);
    }
    boxes.set_shifts(shifts);
}
inline void make_boxes(const detail::BlobData& asset, Random& random, bool within, SixteenBoxes& boxes) {
    const unsigned unit = asset.bits > 16 ? asset.bits - 16u : 0u;
    for (std::size_t k = 0; k < 3; ++k)
        set_boxes(random, k, within ? (static_cast<unsigned>(asset.extent[k]) >> unit) + 1 : 1u << 16, boxes);
}

/// At a point of one of the boxes or anywhere; from anywhere. False when the ray is none.
template <class Boxes>
bool make_ray(const detail::BlobData& asset, const Boxes& boxes, Random& random, detail::IntegerRay& ray) {
    Ray world = some_ray(asset, random);
    if (random.below(4) != 0) {
        const unsigned child = random.below(Boxes::children);
        float at[3];
        for (int k = 0; k < 3; ++k) {
            const std::int32_t low = boxes.node.low(k, child, asset.bits), high = boxes.node.high(k, child, asset.bits);
            const std::int32_t steps = random.below(4) == 0   ? low
                                       : random.below(4) == 0 ? high
                                                              : random.between(low, high);
            at[k] = asset.origin[k] + std::ldexp(static_cast<float>(steps), asset.step_exponent);
        }
        world.direction = {at[0] - world.origin.x, at[1] - world.origin.y, at[2] - world.origin.z};
    }
    float reach = 0.0f;
    return detail::round_ray(asset, world, ray, reach);
}

/// Whether the ray passes through a box of lattice steps within its window; and, where there is a limit, no farther
/// ahead than that.
inline bool passes_exactly(const detail::IntegerRay& ray, const std::int32_t* low, const std::int32_t* high,
                           const std::int32_t* last_ahead = nullptr) {
    Rational first = Rational::of(ray.tau_min);
    bool is_endless = ray.tau_max == infinity;
    Rational last = is_endless ? Rational(0) : Rational::of(ray.tau_max);
    const auto no_later_than = [&](const Rational& tau) {
        if (is_endless || tau < last) last = tau;
        is_endless = false;
    };
    for (int k = 0; k < 3; ++k) {
        const Rational origin = Rational::of(std::int64_t{ray.origin[k]}, -ray.fraction_bits);
        const Rational to_low = Rational(low[k]) - origin, to_high = Rational(high[k]) - origin;
        const std::int32_t way = ray.direction[k];
        if (way == 0) {
            if (to_low.sign() > 0 || to_high.sign() < 0) return false;
            continue;
        }
        const Rational enter = (way > 0 ? to_low : to_high) / Rational(way);
        if (first < enter) first = enter;
        no_later_than((way > 0 ? to_high : to_low) / Rational(way));
    }
    const std::int32_t forth = ray.direction[ray.axis[2]];
    if (last_ahead != nullptr)
        no_later_than(Rational::of(std::int64_t{*last_ahead}, -ray.fraction_bits) /
                      Rational(forth < 0 ? -forth : forth));
    return !(last < first);
}

/// The same of a child's box.
template <class Node>
bool passes_exactly(const detail::IntegerRay& ray, const Node& node, unsigned bits, unsigned child,
                    const std::int32_t* last_ahead = nullptr) {
    std::int32_t low[3], high[3];
    for (int k = 0; k < 3; ++k) {
        low[k] = node.low(k, child, bits);
        high[k] = node.high(k, child, bits);
    }
    return passes_exactly(ray, low, high, last_ahead);
}

/// Calls with a hundred rays for each seed, and boxes for each ray.
template <class Boxes, class Call>
void for_each_ray(std::uint32_t seeds, bool within, Call call) {
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        Random random(seed);
        const detail::BlobData asset = some_asset(random);
        for (int i = 0; i < 100; ++i) {
            Boxes boxes;
            make_boxes(asset, random, within, boxes);
            detail::IntegerRay ray;
            if (make_ray(asset, boxes, random, ray)) call(asset, boxes, ray, random);
        }
    }
}

}  // namespace espalier::tests
