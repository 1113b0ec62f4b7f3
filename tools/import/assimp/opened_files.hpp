// The files that assimp opens: the mesh and what it refers to.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <assimp/IOSystem.hpp>

namespace espalier::tools {

/// The paths of files that assimp opened or looked for.
struct OpenedFiles {
    std::vector<std::string>& opened;
    std::vector<std::string> missing = {};  ///< those that are not there, or are folders
    std::string unreadable = {};            ///< the first one of which reading failed
    int error = 0;                          ///< why, a value of errno
};

/// Returns a reader of files that fills the lists, which must live as long. Texts in UTF-16 are converted to UTF-8.
std::unique_ptr<Assimp::IOSystem> list_opened_files(OpenedFiles& files);

}  // namespace espalier::tools
