#include "platform/input_file.hpp"

#include <io.h>

#include <algorithm>

namespace espalier::tools {

InputFile::InputFile(const std::filesystem::path& path) : file_(::_wfopen(path.c_str(), L"rb")) {
    if (file_ == nullptr) error_ = errno;
}

std::uint64_t InputFile::size() const {
    if (file_ == nullptr) return 0;
    return static_cast<std::uint64_t>(std::max<__int64>(::_filelengthi64(::_fileno(file_)), 0));
}

}  // namespace espalier::tools
