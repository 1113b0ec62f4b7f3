#include "broad_phase.hpp"

namespace espalier::bench::moving {
namespace {

/// The loop in float that a program has which hands boxes to its broad phase: the box of a turned cube.
class PlacementLoop final : public BroadPhase {
public:
    explicit PlacementLoop(const Start& start) : boxes_(start.boxes.begin(), start.boxes.end()) {}

    void step(const Frame& frame, Parts& parts, PairList&) override {
        parts.begin();
        for (const Movement& movement : frame.movements) boxes_[movement.instance.slot] = box_at(movement.transform);
        parts.end(Part::update);
    }

private:
    static Box box_at(const Transform& t) {
        const Quaternion& q = t.rotation;
        const float xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
        const float xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
        const float wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
        const float half = 0.5f * t.scale;
        const auto reach = [half](float a, float b, float c) {
            return half * (std::abs(a) + std::abs(b) + std::abs(c));
        };
        const float x = reach(1.0f - 2.0f * (yy + zz), 2.0f * (xy - wz), 2.0f * (xz + wy));
        const float y = reach(2.0f * (xy + wz), 1.0f - 2.0f * (xx + zz), 2.0f * (yz - wx));
        const float z = reach(2.0f * (xz - wy), 2.0f * (yz + wx), 1.0f - 2.0f * (xx + yy));
        const Vec3& at = t.translation;
        return {{at.x - x, at.y - y, at.z - z}, {at.x + x, at.y + y, at.z + z}};
    }

    std::vector<Box> boxes_;
};

}  // namespace

BroadPhaseMakers placement_loop_makers() {
    BroadPhaseMakers makers = {maker_of<PlacementLoop>("loop that makes boxes", "placements")};
    makers[0].finds = Finds::none;
    makers[0].has_history = false;
    return makers;
}

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
        std::inclusive_scan(starts_.begin(), starts_.end(), starts_.begin());
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
        std::exclusive_scan(ends_.begin(), ends_.end(), ends_.begin(), std::uint32_t{0});
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

}  // namespace espalier::bench::moving

// The lanes of the processor, chosen when the program starts.
#if defined(__x86_64__) && defined(__GLIBC__)
#define ESPALIER_BENCH_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define ESPALIER_BENCH_CLONES
#endif

namespace espalier::bench::moving {
namespace {

/// The sides of boxes along y and z, each an array.
struct Sides {
    const float *low_y, *high_y, *low_z, *high_z;
};

/// Writes which of the boxes from `first` on touch a box along y and z, a byte each.
ESPALIER_BENCH_CLONES void find_touching(const Sides& sides, std::size_t first, std::size_t count, const Box& box,
                                         unsigned char* touching) {
    const float low_y = box.min.y, high_y = box.max.y, low_z = box.min.z, high_z = box.max.z;
    const float *const a = sides.low_y + first, *const b = sides.high_y + first;
    const float *const c = sides.low_z + first, *const d = sides.high_z + first;
    for (std::size_t i = 0; i < count; ++i)
        touching[i] =
            static_cast<unsigned char>((a[i] <= high_y) & (b[i] >= low_y) & (c[i] <= high_z) & (d[i] >= low_z));
}

/// Boxes sorted by their low sides along x, from scratch in each step, and a sweep over them.
class SortAndSweep final : public BroadPhase {
public:
    explicit SortAndSweep(const Start& start)
        : keys_(start.boxes.size()),
          spare_(start.boxes.size()),
          low_x_(start.boxes.size()),
          touching_(start.boxes.size() + 8) {
        for (std::vector<float>& side : sides_) side.resize(start.boxes.size());
    }

    void step(const Frame& frame, Parts& parts, PairList& pairs) override {
        parts.begin();
        sort(frame.boxes);
        parts.end(Part::update);
        sweep(frame.boxes, pairs);
        parts.end(Part::pairs);
    }

private:
    struct Keyed {
        std::uint32_t key;
        std::uint32_t slot;
    };

    void sort(std::span<const Box> boxes) {
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
            const auto bits = std::bit_cast<std::uint32_t>(boxes[i].min.x);
            keys_[i] = {bits ^ ((bits >> 31) != 0 ? 0xFFFFFFFFu : 0x80000000u), i};
        }
        for (unsigned shift = 0; shift < 32; shift += 11) {
            sort_by_digit(shift);
            keys_.swap(spare_);
        }
        for (std::size_t i = 0; i < keys_.size(); ++i) {
            const Box& box = boxes[keys_[i].slot];
            low_x_[i] = box.min.x;
            sides_[0][i] = box.min.y;
            sides_[1][i] = box.max.y;
            sides_[2][i] = box.min.z;
            sides_[3][i] = box.max.z;
        }
    }
    void sort_by_digit(unsigned shift) {
        constexpr std::uint32_t digits = 1u << 11;
        std::uint32_t starts[digits] = {};
        for (const Keyed& keyed : keys_) ++starts[keyed.key >> shift & (digits - 1)];
        std::exclusive_scan(std::begin(starts), std::end(starts), std::begin(starts), std::uint32_t{0});
        for (const Keyed& keyed : keys_) spare_[starts[keyed.key >> shift & (digits - 1)]++] = keyed;
    }
    void sweep(std::span<const Box> boxes, PairList& pairs) {
        const Sides sides = {sides_[0].data(), sides_[1].data(), sides_[2].data(), sides_[3].data()};
        for (std::size_t i = 0; i < keys_.size(); ++i) {
            const std::uint32_t slot = keys_[i].slot;
            const Box& box = boxes[slot];
            const auto from = low_x_.begin() + static_cast<std::ptrdiff_t>(i) + 1;
            const auto count = static_cast<std::size_t>(std::upper_bound(from, low_x_.end(), box.max.x) - from);
            find_touching(sides, i + 1, count, box, touching_.data());
            std::memset(&touching_[count], 0, 8);
            for (std::size_t first = 0; first < count; first += 8) {
                std::uint64_t eight = 0;
                std::memcpy(&eight, &touching_[first], 8);
                if (eight == 0) continue;
                for (std::size_t k = first; k < first + 8; ++k)
                    if (touching_[k] != 0) pairs.add(slot, keys_[i + 1 + k].slot);
            }
        }
    }

    std::vector<Keyed> keys_, spare_;
    std::vector<float> low_x_, sides_[4];
    std::vector<unsigned char> touching_;
};

}  // namespace

BroadPhaseMakers sort_and_sweep_makers() {
    BroadPhaseMakers makers = {maker_of<SortAndSweep>("sort and sweep", "boxes")};
    makers[0].has_history = false;
    return makers;
}

}  // namespace espalier::bench::moving
