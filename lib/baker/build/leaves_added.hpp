// What a split costs that leaves more leaves than it must.
#pragma once

#include <cstdint>

namespace espalier::baker {

/// The cost of a split in addition to the areas of its parts: the leaves that it adds, as a share of their triangles in
/// the range's box. Large ranges are split anywhere, since their parts are split again.
class LeavesAdded {
public:
    /// `area` is that of the box around the range.
    LeavesAdded(std::uint32_t count, float area, unsigned full_leaf)
        : count_(count), full_leaf_(count <= most_leaves * full_leaf ? full_leaf : 0) {
        if (full_leaf_ == 0 || count_ <= full_leaf_) return;
        leaf_cost_ = share * area * static_cast<float>(full_leaf_);
    }
    [[nodiscard]] float cost(std::uint32_t left_count) const {
        if (leaf_cost_ == 0.0f) return 0.0f;
        const std::uint32_t added = leaves_of(left_count) + leaves_of(count_ - left_count) - leaves_of(count_);
        return leaf_cost_ * static_cast<float>(added);
    }

private:
    static constexpr std::uint32_t most_leaves = 6;
    static constexpr float share = 0.125f;

    [[nodiscard]] std::uint32_t leaves_of(std::uint32_t count) const { return (count + full_leaf_ - 1) / full_leaf_; }

    std::uint32_t count_;
    unsigned full_leaf_;
    float leaf_cost_ = 0.0f;
};

}  // namespace espalier::baker
