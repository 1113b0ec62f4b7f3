// The check of a deformable blob: its vertices are positions of the sources, and all is as refit() leaves it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include <espalier/blob.hpp>

#include <baker/verify/decode_tree.hpp>

namespace espalier::baker {

/// Returns nothing, or the first fault. The blob is open and deformable, and has the bytes.
[[nodiscard]] std::optional<std::string> check_motion(std::span<const std::byte> bytes, const Blob& blob,
                                                      const TreeBytes& tree);

}  // namespace espalier::baker
