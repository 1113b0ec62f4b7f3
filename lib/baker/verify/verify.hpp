// What `open` need not prove because no query's safety hangs on it: that a blob describes what it says it describes.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace espalier::baker {

/// Nothing, or the first thing that is wrong, naming node or triangle and the byte offset: that the blob opens, that
/// every box holds all vertices below it and ends near the asset, that no triangle is without area and no two are the
/// same, that a leaf's vertices are numbered by first use, and that extent, vertex count, the closed flag, copies, edge
/// flags and bounds are true. Of triangles with copies each corner must lie in the boxes of one of their leaves.
/// Needs about 60 bytes of memory for each triangle.
[[nodiscard]] std::optional<std::string> verify_deep(std::span<const std::byte> bytes);

}  // namespace espalier::baker
