// The kinds of steps that lead from number to number in the section of original ids, and which take few bits.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <espalier/format.hpp>

namespace espalier::baker {

/// The last numbers of the rows of the source that a block passes through, the newest first.
class RecentNumbers {
public:
    explicit RecentNumbers(std::uint32_t first) { numbers_.fill(first); }

    [[nodiscard]] std::uint32_t operator[](unsigned place) const { return numbers_[place]; }

    /// Puts `number` in front. Those before `replaced` move one place back, the one there is lost.
    void add(std::uint32_t number, unsigned replaced) {
        std::copy_backward(numbers_.begin(), numbers_.begin() + replaced, numbers_.begin() + replaced + 1);
        numbers_[0] = number;
    }

private:
    std::array<std::uint32_t, format::ids::recent_numbers> numbers_;
};

/// A step to any number from `offset` after a recent one on, as far as its field reaches.
struct IdKind {
    std::uint32_t offset = 0;
    unsigned width = 0;
    unsigned from = 0;      ///< place of the recent number that it counts from
    unsigned replaced = 0;  ///< place of the one that is lost: `from` in the same row, the last for a new row
    unsigned prefix = 0;    ///< bits of its code
    unsigned code = 0;      ///< low bits first; no code begins with another

    [[nodiscard]] bool reaches(std::uint32_t number, const RecentNumbers& recent, std::uint32_t mask) const {
        return std::uint64_t{(number - recent[from] - offset) & mask} >> width == 0;
    }
};

/// Calls `take` with the place of each run of a block and the numbers that it steps to, from the block's first on.
template <class Take>
void for_each_run(std::span<const std::uint32_t> block, Take take) {
    constexpr std::size_t of_run = format::ids::run_triangles(true);
    for (std::size_t at = 0; at < block.size(); at += of_run) {
        const auto run = block.subspan(at, std::min<std::size_t>(block.size() - at, of_run));
        take(static_cast<unsigned>(at / of_run), at == 0 ? run.subspan(1) : run);
    }
}

struct IdKinds {
    unsigned kind_bits = 0;     ///< no code is longer
    std::vector<IdKind> kinds;  ///< the first takes every step; every row of kind_bits bits begins with the code of one
};

/// Returns kinds that take few bits for these numbers, each below 2^number_bits, with the table that holds them. Starts
/// with many, drops those whose absence costs least, and keeps the best set on the way; another may take fewer bits.
/// For a large mesh it counts the steps of an even sample of the blocks.
[[nodiscard]] IdKinds choose_id_kinds(std::span<const std::uint32_t> numbers, unsigned number_bits);

}  // namespace espalier::baker
