// One step of the build: a range of triangles is parted in two.
#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include <baker/base/lane_box.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// A triangle's box and number, moved about as a whole so that every pass reads memory in order.
struct alignas(16) Reference {
    float lo[3];
    std::uint32_t triangle;
    float hi[3];
    std::uint32_t unused;
};
static_assert(sizeof(Reference) == 32);

/// Fills in the reference of a triangle and returns its box.
LaneBox put_reference(const LatticeMesh& mesh, std::uint32_t triangle, Reference& reference);

/// Twice a box's centre: a sum of whole numbers, rounded alike everywhere.
[[nodiscard]] inline float center_of(const Reference& reference, unsigned axis) {
    return reference.lo[axis] + reference.hi[axis];
}

/// Along one axis; of equal centres the lower triangle comes first, so that no two references are equal.
struct ByCenter {
    unsigned axis;
    [[nodiscard]] bool operator()(const Reference& a, const Reference& b) const {
        const float center_a = center_of(a, axis);
        const float center_b = center_of(b, axis);
        return center_a != center_b ? center_a < center_b : a.triangle < b.triangle;
    }
};

/// References first .. first + count - 1 of all, the box around them, and the box around twice their centres.
struct SplitRange {
    std::uint32_t first;
    std::uint32_t count;
    LaneBox box;
    LaneBox centers;
};

struct SplitRule {
    unsigned bins;         ///< candidate planes per axis; 0: split in halves, whatever the cost
    unsigned exact_below;  ///< ranges with at most this many triangles try every split along every axis
    unsigned full_leaf;    ///< triangles of a full leaf: a few of them are split so that few leaves result; 0: anywhere
};

inline constexpr unsigned max_bins = 64;
inline constexpr unsigned max_exact = 256;

/// Reorders the references of the range, two or more, and returns the two parts, neither empty. Which order is a
/// function of the order before.
[[nodiscard]] std::pair<SplitRange, SplitRange> split(std::span<Reference> references, const SplitRange& range,
                                                      const SplitRule& rule);

}  // namespace espalier::baker
