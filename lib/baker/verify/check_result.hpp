// Last stage, always on: what was written is read back and compared with what was meant.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include <baker/build/binary_tree.hpp>
#include <baker/collapse/order.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// Nothing, or what is wrong: every box holds all that is below it, every triangle is the intended one, corner by
/// corner, and the header's counts are right.
[[nodiscard]] std::optional<std::string> check_result(std::span<const std::byte> blob, const LatticeMesh& mesh,
                                                      const BinaryTree& binary, const WideTree& wide);

}  // namespace espalier::baker
