// The files that assimp opens: the mesh and what it refers to.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <assimp/IOSystem.hpp>

namespace espalier::tools {

/// Returns a reader of files that adds the path of each opened file to `opened`, and of each one that is not there to
/// `missing`; both must live as long. Texts in UTF-16 are converted to UTF-8.
std::unique_ptr<Assimp::IOSystem> list_opened_files(std::vector<std::string>& opened,
                                                    std::vector<std::string>& missing);

}  // namespace espalier::tools
