// The refusals that lookups by triangle and of optional sections have in common.
#pragma once

#include <cstddef>

#include <espalier/blob.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier::detail {

/// Returns whether a blob has the section, which is null without it.
inline QueryStatus status_of_section(const BlobData& blob, const std::byte* section) {
    if (blob.bytes == nullptr) return QueryStatus::not_open;
    return section == nullptr ? QueryStatus::no_data : QueryStatus::ok;
}

/// Returns ok for a triangle with an index below `count`. The triangle of a miss is not_found.
inline QueryStatus status_of_triangle(TriangleId triangle, std::size_t count) {
    if (triangle.index < count) return QueryStatus::ok;
    return triangle == no_triangle ? QueryStatus::not_found : QueryStatus::invalid_argument;
}

inline QueryStatus status_of_lookup(const BlobData& blob, const std::byte* section, TriangleId triangle) {
    const QueryStatus status = status_of_section(blob, section);
    return status == QueryStatus::ok ? status_of_triangle(triangle, blob.triangle_count) : status;
}

}  // namespace espalier::detail
