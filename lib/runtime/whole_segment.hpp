// A segment between lattice points, as the walk sees it and as the kernel does: in integers, on every machine.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/lattice.hpp>
#include <runtime/box_nodes.hpp>
#include <runtime/lattice_triangle.hpp>

namespace espalier::detail {

/// Where a segment crosses a triangle: at numerator / denominator of its length, 0 <= numerator <= denominator.
struct Crossing {
    Int128 numerator;
    Int128 denominator;
    bool front;
};

struct WholeSegment {
    static constexpr int fraction_bits = 0;

    std::int32_t origin[3];     ///< within 2^29
    std::int32_t direction[3];  ///< to the end: within 2^30
    int longest;                ///< axis
    bool is_narrow;             ///< its length, and what it sees of any vertex, are at most 2^24 along every axis
    int key_shift;              ///< no key has more than 30 bits
    // Of what is left of it in front of the first hit so far.
    IntegerBounds bounds;
    std::uint32_t steps_left;  ///< along the longest axis

    /// False where it has no length.
    bool set(const BlobData& blob, const SegmentInSteps& from_caller);
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

/// The segment's line, seen along an axis that it is not longest along: a line in a plane. It tells on which side of it
/// a place is, by products of 32 bits: as surely as their error allows, and never the wrong one.
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
