// The first contact of two blobs, for queries of many pairs with one limit of work.
#pragma once

#include <cstdint>

#include <espalier/pair.hpp>

namespace espalier::detail {

/// Returns what first_contact() returns for a limit of `work`, and takes from it what the search has used.
PairContact find_first_contact(const PlacedBlob& a, const PlacedBlob& b, std::uint64_t& work) noexcept;

}  // namespace espalier::detail
