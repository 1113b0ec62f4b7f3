// Pointers of Git LFS: small texts that stand where large files belong until `git lfs pull` fetches them.
#pragma once

#include <string>
#include <string_view>

#include <import/base/numbers.hpp>

namespace espalier::importer {

inline bool is_git_lfs_pointer(std::string_view begin) {
    return begin.starts_with("version https://git-lfs.github.com/spec/");
}

inline std::string words_for_git_lfs_pointer(const std::string& path) {
    return text('\'', printable(path),
                "' is a pointer of Git LFS in the place of the file. Fetch the file: git lfs pull.");
}

}  // namespace espalier::importer
