// The arrays that batches take and fill, for callers whose numbers already lie in arrays of their own.
//
// A batch writes, bit for bit, what a call for each query would return. It refuses a blob that is not open (not_open),
// and an array that is null or whose size does not match (invalid_argument); it then writes nothing. The status of each
// single query is part of its result.
#pragma once

#include <cstddef>

#include <espalier/base/compiler.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// One argument of a batch for each query. The argument of query i lies i * stride bytes after the first, at any
/// alignment. A stride of 0 repeats one value for all queries, and a negative stride runs backwards.
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
    /// Returns the arguments from index `query` on, for the rest of a batch. A null array stays null.
    [[nodiscard]] Strided from(std::size_t query) const noexcept {
        if (first == nullptr) return *this;
        return {static_cast<const char*>(first) + static_cast<std::ptrdiff_t>(query) * stride, stride};
    }
};

/// The outcome of a batch that fills lists. All lists lie one after the other in a single array: the list of query i
/// begins at offsets[i] and ends at offsets[i + 1]. Only complete lists are written.
///
/// After output_full, call again with the queries from `lists` on and with room for at least `needed` elements.
struct [[nodiscard]] FilledLists {
    std::size_t lists = 0;   ///< number of complete lists: those of the first queries
    std::size_t count = 0;   ///< number of elements in these lists
    std::size_t needed = 0;  ///< number of elements in the next list; 0 unless the status is output_full
    QueryStatus status = QueryStatus::not_open;  ///< ok, output_full, or why the batch was refused
};

}  // namespace espalier
