#include <algorithm>

#include "../broad_phase.hpp"

namespace espalier::bench {
namespace {

/// A uniform grid, filled anew in each step. A cell is as large as the largest box, so that a box is stored once, in
/// the cell of its lowest corner, and touches only boxes of that cell and of the 26 around it. Boxes are sorted by
/// cell, and cells that follow one another along x are one range.
class Grid final : public BroadPhase {
public:
    Grid(const Start& start, bool sorts_pairs)
        : sorts_pairs_(sorts_pairs), cell_of_(start.boxes.size()), sorted_(start.boxes.size()) {}

    void step(const Frame& frame, Parts& parts, PairList& pairs) override {
        parts.begin();
        choose_cells(frame.boxes);
        fill(frame.boxes);
        parts.end(Part::update);
        find_pairs(pairs);
        if (sorts_pairs_) sort(pairs);
        parts.end(Part::pairs);
    }

private:
    struct Entry {
        Box box;
        std::uint32_t slot;
        std::uint32_t cell;
    };

    void choose_cells(std::span<const Box> boxes) {
        Box all = boxes[0];
        float largest = 0.0f;
        for (const Box& box : boxes) {
            all.min = {std::min(all.min.x, box.min.x), std::min(all.min.y, box.min.y), std::min(all.min.z, box.min.z)};
            all.max = {std::max(all.max.x, box.max.x), std::max(all.max.y, box.max.y), std::max(all.max.z, box.max.z)};
            largest = std::max({largest, box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z});
        }
        low_ = all.min;
        // A little larger, since the number of a cell is rounded.
        per_length_ = 1.0f / (1.001f * largest);
        const auto cells = [this](float low, float high) {
            return static_cast<std::uint32_t>((high - low) * per_length_) + 1;
        };
        // A cell more on each side has no boxes, and makes tests of borders unnecessary.
        row_ = cells(all.min.x, all.max.x) + 2;
        layer_ = row_ * (cells(all.min.y, all.max.y) + 2);
        starts_.assign(std::size_t{layer_} * (cells(all.min.z, all.max.z) + 2) + 1, 0);
    }
    void fill(std::span<const Box> boxes) {
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const Vec3& at = boxes[i].min;
            const auto number = [this](float x, float low) {
                return static_cast<std::uint32_t>((x - low) * per_length_) + 1;
            };
            cell_of_[i] = number(at.x, low_.x) + row_ * number(at.y, low_.y) + layer_ * number(at.z, low_.z);
            ++starts_[cell_of_[i]];
        }
        std::uint32_t sum = 0;
        for (std::uint32_t& start : starts_) start = sum += start;
        // Each start is the end of its cell at first, and moves down.
        for (std::size_t i = boxes.size(); i-- > 0;)
            sorted_[--starts_[cell_of_[i]]] = {boxes[i], static_cast<std::uint32_t>(i), cell_of_[i]};
    }
    void find_pairs(PairList& pairs) const {
        for (std::uint32_t i = 0; i < sorted_.size(); ++i) {
            const Entry& entry = sorted_[i];
            const std::uint32_t cell = entry.cell;
            test(entry, i + 1, starts_[cell + 2], pairs);
            for (const std::uint32_t middle : {cell + row_, cell + layer_ - row_, cell + layer_, cell + layer_ + row_})
                test(entry, starts_[middle - 1], starts_[middle + 2], pairs);
        }
    }
    void test(const Entry& entry, std::uint32_t from, std::uint32_t to, PairList& pairs) const {
        const Box& a = entry.box;
        for (std::uint32_t i = from; i < to; ++i) {
            const Box& b = sorted_[i].box;
            const bool touch = (a.min.x <= b.max.x) & (b.min.x <= a.max.x) & (a.min.y <= b.max.y) &
                               (b.min.y <= a.max.y) & (a.min.z <= b.max.z) & (b.min.z <= a.max.z);
            if (touch) pairs.add(entry.slot, sorted_[i].slot);
        }
    }

    /// Sorts as Espalier does: by counting for the lower slots, by insertion for the few pairs of each.
    void sort(PairList& pairs) {
        const std::span<const InstancePair> found = pairs.found();
        ends_.assign(sorted_.size() + 1, 0);
        for (const InstancePair& pair : found) ++ends_[std::min(pair.a, pair.b)];
        std::uint32_t sum = 0;
        for (std::uint32_t& end : ends_) {
            const std::uint32_t size = end;
            end = sum;
            sum += size;
        }
        spare_.resize(found.size());
        for (const InstancePair& pair : found)
            spare_[ends_[std::min(pair.a, pair.b)]++] = {std::min(pair.a, pair.b), std::max(pair.a, pair.b)};
        const std::span<InstancePair> out = pairs.room();
        for (std::size_t i = 0; i < spare_.size(); ++i) {
            std::size_t at = i;
            for (; at > 0 && spare_[i] < out[at - 1]; --at) out[at] = out[at - 1];
            out[at] = spare_[i];
        }
    }

    bool sorts_pairs_;
    Vec3 low_;
    float per_length_ = 0.0f;
    std::uint32_t row_ = 0, layer_ = 0;
    std::vector<std::uint32_t> starts_;
    std::vector<std::uint32_t> cell_of_;
    std::vector<Entry> sorted_;
    std::vector<std::uint32_t> ends_;
    std::vector<InstancePair> spare_;
};

}  // namespace

BroadPhaseMakers grid_makers() {
    BroadPhaseMakers makers = {maker_of<Grid>("grid", "boxes", false), maker_of<Grid>("grid, sorted", "boxes", true)};
    for (BroadPhaseMaker& maker : makers) maker.has_history = false;
    return makers;
}

}  // namespace espalier::bench
