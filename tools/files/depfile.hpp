// What a build system is told about a bake: which files were read, in the syntax of Make, which Ninja and CMake read
// too.
#pragma once

#include <span>
#include <string>

namespace espalier::tools {

/// One rule: `target` is to be made again when one of `sources` changes. Throws CommandError (unsupported) when a path
/// cannot be said in this syntax.
std::string depfile_text(const std::string& target, std::span<const std::string> sources);

}  // namespace espalier::tools
