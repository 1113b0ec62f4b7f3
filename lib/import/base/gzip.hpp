// Files that gzip packed: readers see what is in them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace espalier::importer {

/// Tests whether bytes begin as gzip with deflate, its only method.
inline bool is_gzip(std::string_view begin) { return begin.starts_with("\x1F\x8B\x08"); }

/// Returns the unpacked bytes, or the first ones, at most so many. Throws ImportError: (invalid_input) for a file that
/// is damaged or cut off, (unsupported) in a build without zlib.
std::string unpack_gzip(const std::string& path, std::string_view packed, std::size_t most);

}  // namespace espalier::importer
