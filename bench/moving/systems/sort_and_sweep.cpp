#include <algorithm>
#include <bit>
#include <cstring>

#include "../broad_phase.hpp"

// The lanes of the processor, chosen when the program starts.
#if defined(__x86_64__) && defined(__GLIBC__)
#define ESPALIER_BENCH_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define ESPALIER_BENCH_CLONES
#endif

namespace espalier::bench {
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
        std::uint32_t sum = 0;
        for (std::uint32_t& start : starts) {
            const std::uint32_t size = start;
            start = sum;
            sum += size;
        }
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

}  // namespace espalier::bench
