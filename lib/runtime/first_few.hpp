// The first few of many, kept in an array of the caller's: a heap with the last of them on top, sorted at the end
// (Williams 1964).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/blob.hpp>

namespace espalier::detail {

/// `Before` orders values: before(a, b) says whether a comes before b.
template <class Value, class Before>
class FirstFew {
public:
    FirstFew(std::span<Value> places, Before before) : places_(places), before_(before) {}

    [[nodiscard]] std::size_t count() const { return count_; }
    /// Whether a value did not fit: the one that was offered, or the one that gave way to it.
    [[nodiscard]] bool has_overflowed() const { return overflowed_; }
    [[nodiscard]] bool is_empty() const { return count_ == 0; }
    /// The last of those that are kept; there must be one.
    [[nodiscard]] const Value& last() const { return places_[0]; }
    /// Whether the value of this triangle is kept already: one that has copies is met in several leaves.
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
                if (!before_(places_[parent], places_[child])) break;
                swap(parent, child);
                child = parent;
            }
            return;
        }
        overflowed_ = true;
        if (count_ == 0 || !before_(value, places_[0])) return;
        places_[0] = value;
        sink(count_);
    }

    /// First to last; nothing may be offered afterwards.
    void sort() {
        // mutant(> -> >=) equivalent: swaps the first with itself
        for (std::size_t rest = count_; rest > 1;) {
            swap(0, --rest);
            sink(rest);
        }
    }

private:
    void swap(std::size_t i, std::size_t j) {
        const Value value = places_[i];
        places_[i] = places_[j];
        places_[j] = value;
    }
    /// Puts the top of the first `size` places where it belongs.
    void sink(std::size_t size) {
        std::size_t parent = 0;
        for (std::size_t child = 1; child < size; child = 2 * parent + 1) {
            if (child + 1 < size && before_(places_[child], places_[child + 1])) ++child;
            if (!before_(places_[parent], places_[child])) return;
            swap(parent, child);
            parent = child;
        }
    }

    std::span<Value> places_;
    Before before_;
    std::size_t count_ = 0;
    bool overflowed_ = false;
};

}  // namespace espalier::detail
