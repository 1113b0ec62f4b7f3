// The files that a bake read, for a build system, in the syntax of Make, which Ninja and CMake read too.
#pragma once

#include <span>
#include <string>

namespace espalier::tools {

/// Returns one rule: `target` is made again when one of `sources` changes. Throws CommandError (unsupported) for a path
/// that this syntax cannot express.
std::string depfile_text(const std::string& target, std::span<const std::string> sources);

}  // namespace espalier::tools
