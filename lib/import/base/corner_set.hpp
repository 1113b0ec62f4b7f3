// A set of corners that finds the next one from any corner on.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace espalier::importer {

/// One bit for each corner, and above each 64 bits one that is set if any of them is.
class CornerSet {
public:
    /// Becomes the empty set of so many possible corners, at least one.
    void reset(std::uint32_t corners) {
        levels_.clear();
        for (std::size_t bits = corners;;) {
            bits = (bits + 63) / 64;
            levels_.emplace_back(bits);
            if (bits == 1) return;
        }
    }
    void set(std::size_t corner, bool is_in) {
        for (auto& level : levels_) {
            std::uint64_t& word = level[corner / 64];
            const std::uint64_t bit = std::uint64_t{1} << corner % 64;
            word = is_in ? word | bit : word & ~bit;
            is_in = word != 0;
            corner /= 64;
        }
    }
    /// Returns the first one from `corner` on, and behind the last corner from the first on.
    [[nodiscard]] std::optional<std::uint32_t> next_round(std::uint32_t corner) const {
        const auto found = next(corner);
        return found ? found : next(0);
    }

private:
    [[nodiscard]] std::optional<std::uint32_t> next(std::size_t at) const {
        std::size_t level = 0;
        for (;; ++level, at = at / 64 + 1) {
            if (level == levels_.size() || at / 64 >= levels_[level].size()) return std::nullopt;
            const std::uint64_t word = levels_[level][at / 64] >> at % 64;
            if (word == 0) continue;
            at += static_cast<std::size_t>(std::countr_zero(word));
            break;
        }
        while (level-- > 0) at = at * 64 + static_cast<std::size_t>(std::countr_zero(levels_[level][at]));
        return static_cast<std::uint32_t>(at);
    }

    std::vector<std::vector<std::uint64_t>> levels_;
};

}  // namespace espalier::importer
