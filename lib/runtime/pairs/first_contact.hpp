// The first contact of two blobs, for queries of many pairs with one limit of work.
#pragma once

#include <cstdint>

#include <espalier/pair.hpp>
#include <espalier/advanced/statistics.hpp>

namespace espalier::detail {

/// The pairs of boxes that queries may still visit, and who counts what they do with leaves.
struct PairWork {
    std::uint64_t left;
    PairCounters* counters = nullptr;
};

/// Returns what first_contact() returns for a limit of `work.left`, and takes from it what the search has used.
PairContact find_first_contact(const PlacedBlob& a, const PlacedBlob& b, PairWork& work) noexcept;

}  // namespace espalier::detail
