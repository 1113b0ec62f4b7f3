#include "platform/input_file.hpp"

#include <sys/stat.h>

namespace espalier::tools {

InputFile::InputFile(const std::filesystem::path& path) : file_(std::fopen(path.c_str(), "rb")) {
    if (file_ == nullptr) error_ = errno;
}

std::uint64_t InputFile::size() const {
    struct stat facts {};
    const bool is_known = file_ != nullptr && ::fstat(::fileno(file_), &facts) == 0 && S_ISREG(facts.st_mode);
    return is_known ? static_cast<std::uint64_t>(facts.st_size) : 0;
}

}  // namespace espalier::tools
