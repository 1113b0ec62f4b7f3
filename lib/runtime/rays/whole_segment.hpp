// A segment between lattice points, for the walk and for the kernel: in integers, on every machine.
#pragma once

#include <bit>
#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/advanced/lattice.hpp>
#include <espalier/types.hpp>
#include <runtime/lattice/triangle.hpp>
#include <runtime/traversal/box_nodes.hpp>

namespace espalier::detail {

/// Where a segment crosses a triangle: at numerator / denominator of its length, 0 <= numerator <= denominator.
struct Crossing {
    Int128 numerator;
    Int128 denominator;
    bool front;
};

struct WholeSegment {
    static constexpr int fraction_bits = 0;
    static constexpr FaceCulling culling = FaceCulling::none;

    std::int32_t origin[3];     ///< within 2^29
    std::int32_t direction[3];  ///< to the end: within 2^30
    std::uint8_t longest;       ///< axis
    std::uint8_t key_shift;     ///< no key has more than 30 bits
    bool is_narrow;             ///< its length, and its way to any vertex, are at most 2^24 along every axis
    // Around what is left of the segment in front of the first hit so far.
    IntegerBounds bounds;
    std::uint32_t steps_left;  ///< along the longest axis

    /// Returns ok, out_of_range for an end that is too far away, or invalid_argument for one without length.
    QueryStatus set(const BlobData& blob, const LatticeSegment& from_caller);
    /// A key for the walk: within the bounds nothing is farther than the whole length.
    [[nodiscard]] float key_of(std::uint32_t steps) const { return std::bit_cast<float>(steps << key_shift); }
    [[nodiscard]] float limit() const { return key_of(steps_left); }

    /// Ends it at t / 2^31, or a little behind.
    void end_at(std::uint32_t t);
};

/// What numbers mean along each axis: base + number * 2^shift lattice steps. Numbers have `bits` bits, of which one may
/// be their sign.
struct LineGrid {
    std::int32_t base[3];
    int shift[3];
    int bits;
};

/// The segment's line, seen along an axis that it is not longest along: a line in a plane. It returns on which side of
/// it a place is, by products of 32 bits: never the wrong side, and neither where their error does not decide.
class LineSide {
public:
    /// `turn` is 1 or 2: how many axes behind the longest the one is that is looked at.
    LineSide(const WholeSegment& segment, int turn, const LineGrid& grid);

    int axis;  ///< the places' second coordinate; the first is along the longest

    [[nodiscard]] bool rises() const { return along_ >= 0; }
    [[nodiscard]] std::int32_t place(std::int32_t number, std::int32_t number_along) const {
        return base_ + across_ * number - along_ * number_along;
    }
    [[nodiscard]] bool is_below(std::int32_t place) const { return place < -slack_; }
    [[nodiscard]] bool is_above(std::int32_t place) const { return place > slack_; }

private:
    std::int32_t base_, across_, along_, slack_;
};

/// The children, of those in the mask, whose box the segment's line may pass. None that it does pass is left out.
[[nodiscard]] unsigned children_on_line(const WholeSegment& segment, const PackedNode& node, unsigned bits,
                                        unsigned mask);
[[nodiscard]] unsigned children_on_line(const WholeSegment& segment, const PlainNode& node, unsigned bits,
                                        unsigned mask);

/// Whether the segment hits the triangle, exactly.
[[nodiscard]] bool crosses(const WholeSegment& segment, const LatticeTriangle& triangle, Crossing& crossing);

/// numerator / denominator * 2^31, rounded down.
[[nodiscard]] std::uint32_t fixed_point(const Crossing& crossing);
/// Whether a is at less of the length than b, exactly.
[[nodiscard]] bool is_before(const Crossing& a, const Crossing& b);

}  // namespace espalier::detail
