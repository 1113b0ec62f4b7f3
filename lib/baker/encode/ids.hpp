// The section of original ids: numbers by steps from recent ones, each of the kind that takes fewest bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace espalier::baker {

/// Fields of the header about the section.
struct IdSteps {
    unsigned kind_bits = 0;
    std::uint32_t bytes = 0;
};

/// Appends the section for the numbers of all storage indices, each below 2^number_bits.
[[nodiscard]] IdSteps put_ids(std::vector<std::byte>& blob, std::span<const std::uint32_t> numbers,
                              unsigned number_bits);

}  // namespace espalier::baker
