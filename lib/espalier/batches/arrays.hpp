// The arrays that batches take and fill: for callers whose numbers already lie in arrays of their own.
//
// A batch writes the results of one call for each query, bit for bit. It refuses, and then writes nothing: a blob that
// is not open (not_open); and an array that is null or has a size that does not match (invalid_argument). The statuses
// of single queries are in their results.
#pragma once

#include <cstddef>

#include <espalier/base/compiler.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// The arguments of a batch, one for each query: that of query i lies i * stride bytes after the first, at any
/// alignment. A stride of 0 gives all queries the same; a negative one runs backwards.
template <class Value>
struct Strided {
    const void* first = nullptr;
    std::ptrdiff_t stride = sizeof(Value);

    [[nodiscard]] Value at(std::size_t query) const noexcept {
        Value value;
        ESPALIER_COPY_BYTES(&value, static_cast<const char*>(first) + static_cast<std::ptrdiff_t>(query) * stride,
                            sizeof value);
        return value;
    }
    /// Returns the arguments from a query on, for the rest of a batch. Null stays null.
    [[nodiscard]] Strided from(std::size_t query) const noexcept {
        if (first == nullptr) return *this;
        return {static_cast<const char*>(first) + static_cast<std::ptrdiff_t>(query) * stride, stride};
    }
};

/// The result of a batch that fills lists. All lists lie in one array, one after the other: that of query i begins at
/// offsets[i] and ends at offsets[i + 1]. Only whole lists are written.
///
/// After output_full, call again with the queries from `lists` on, and an array with at least `needed` places.
struct [[nodiscard]] FilledLists {
    std::size_t lists = 0;   ///< that are complete: those of the first queries
    std::size_t count = 0;   ///< elements in them
    std::size_t needed = 0;  ///< places that the next list takes; 0 unless the status is output_full
    QueryStatus status = QueryStatus::not_open;  ///< ok, output_full, or why the batch was refused
};

}  // namespace espalier
