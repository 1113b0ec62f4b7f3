// The best k of many values, kept in an array of the caller's: a heap with the last of them on top, sorted at the end
// (Williams 1964).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/distance.hpp>
#include <espalier/ray.hpp>
#include <runtime/base/options.hpp>

namespace espalier::detail {

/// The values with the smallest keys; of equal keys, those of the lowest triangles.
template <class Value, float Value::*key>
class BestK {
public:
    explicit BestK(std::span<Value> places) : places_(places) {}

    [[nodiscard]] bool is_full() const { return count_ == places_.size(); }
    /// Returns whether a value did not fit: the one that was offered, or the one that gave way to it.
    [[nodiscard]] bool has_overflowed() const { return overflowed_; }
    [[nodiscard]] bool is_empty() const { return count_ == 0; }
    /// Returns the largest key; there must be a value.
    [[nodiscard]] float largest_key() const { return places_[0].*key; }
    /// Returns whether a value of this triangle is kept already: one that has copies is met in several leaves.
    [[nodiscard]] bool has(const BlobData& blob, std::uint32_t index) const {
        // mutant(never) work: searches for a triangle that cannot come twice
        if (blob.copies == nullptr) return false;
        for (const Value& value : places_.first(count_))
            if (value.triangle.index == index) return true;
        return false;
    }

    void offer(const Value& value) {
        if (count_ < places_.size()) {
            places_[count_++] = value;
            for (std::size_t child = count_ - 1; child > 0;) {
                const std::size_t parent = (child - 1) / 2;
                if (!comes_before(places_[parent], places_[child])) break;
                swap(parent, child);
                child = parent;
            }
            return;
        }
        overflowed_ = true;
        if (count_ == 0 || !comes_before(value, places_[0])) return;
        places_[0] = value;
        sink(count_);
    }

    /// Sorts the values, best first, and returns them; nothing may be offered afterwards.
    std::span<Value> sorted() {
        // mutant(> -> >=) equivalent: swaps the first with itself
        for (std::size_t rest = count_; rest > 1;) {
            swap(0, --rest);
            sink(rest);
        }
        return places_.first(count_);
    }

private:
    ESPALIER_SHARED_CODE static bool comes_before(const Value& a, const Value& b) {
        // mutant(< -> <= 1, < -> <= 2) equivalent: the two differ here, since no triangle is kept twice
        return a.*key != b.*key ? a.*key < b.*key : a.triangle.index < b.triangle.index;
    }
    void swap(std::size_t i, std::size_t j) {
        const Value value = places_[i];
        places_[i] = places_[j];
        places_[j] = value;
    }
    /// Moves the top down to its place in the heap of the first `size` values.
    void sink(std::size_t size) {
        std::size_t parent = 0;
        for (std::size_t child = 1; child < size; child = 2 * parent + 1) {
            if (child + 1 < size && comes_before(places_[child], places_[child + 1])) ++child;
            if (!comes_before(places_[parent], places_[child])) return;
            swap(parent, child);
            parent = child;
        }
    }

    std::span<Value> places_;
    std::size_t count_ = 0;
    bool overflowed_ = false;
};

/// The first hits of a ray. Until all are found, t is tau, counted from the caller's origin.
using FirstHits = BestK<RayHit, &RayHit::t>;
/// The closest triangles. Until all are found, they are unfinished (nearest_to_local.hpp).
using ClosestFew = BestK<ClosestPoint, &ClosestPoint::distance>;

}  // namespace espalier::detail
