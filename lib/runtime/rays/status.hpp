// The statuses of ray queries, and hits that are none.
#pragma once

#include <bit>

#include <espalier/blob.hpp>
#include <espalier/ray.hpp>
#include <espalier/status.hpp>
#include <runtime/base/small_code.hpp>

namespace espalier::detail {

/// Returns not_open for a blob that was never opened or that open() refused, else not_found.
constexpr QueryStatus nothing_in(const BlobData& blob) {
    return blob.bytes == nullptr ? QueryStatus::not_open : QueryStatus::not_found;
}
/// Returns the status of a list, given that of a single answer: a list without elements is complete.
constexpr QueryStatus of_list(QueryStatus status) {
    return status == QueryStatus::not_found ? QueryStatus::ok : status;
}
/// Returns a hit that is none, with zeros for its numbers.
constexpr RayHit miss_of(float zero, QueryStatus status) {
    return {__builtin_inff(), zero, zero, {zero, zero, zero}, no_triangle, status, Side::front, {}};
}
inline constexpr RayHit no_hit = miss_of(0.0f, QueryStatus::not_found);

/// Returns a hit that is none, with the reason.
inline RayHit miss_with(QueryStatus status) {
    // Small cores store word by word: a call to clear the rest, or a copy from a constant, takes more of them.
    if (!takes_shortcut()) return miss_of(std::bit_cast<float>(as_if_changed(0u)), status);
    // Others copy whole registers, which the caller's copy need not wait for.
    RayHit miss = no_hit;
    if (status != QueryStatus::not_found) miss.status = status;
    return miss;
}

}  // namespace espalier::detail
