// The few closest triangles, as they are collected.
#pragma once

#include <cstdint>
#include <span>

#include <espalier/nearest.hpp>
#include <runtime/first_few.hpp>
#include <runtime/found.hpp>

namespace espalier::detail {

/// In the caller's array. Until all are found, their distances are squared and in lattice steps.
class ClosestFew {
public:
    ClosestFew(const BlobData& blob, std::span<Nearest> places)
        : blob_(blob), places_(places), kept_(places, comes_before) {}

    [[nodiscard]] bool is_full() const { return kept_.count() == places_.size(); }
    /// The largest squared distance that is kept; there must be one.
    [[nodiscard]] float last() const { return kept_.last().distance; }
    [[nodiscard]] bool has(std::uint32_t index) const { return kept_.has(blob_, index); }
    void offer(const FoundNearest& found);
    /// Sorts what was found and translates the distances. How many there are.
    std::size_t finish(float distance_offset, float max_distance);

private:
    static bool comes_before(const Nearest& a, const Nearest& b) {
        // mutant(< -> <= 1, < -> <= 2) equivalent: the two differ here, since no triangle is kept twice
        return a.distance != b.distance ? a.distance < b.distance : a.triangle.index < b.triangle.index;
    }

    const BlobData& blob_;
    std::span<Nearest> places_;
    FirstFew<Nearest, bool (*)(const Nearest&, const Nearest&)> kept_;
};

}  // namespace espalier::detail
