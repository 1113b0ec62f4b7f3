#include "files.hpp"

namespace espalier::tools {

InputFile::~InputFile() {
    if (file_ != nullptr && file_ != stdin) std::fclose(file_);
}

std::size_t InputFile::read(std::span<std::byte> bytes) {
    if (file_ == nullptr || error_ != 0) return 0;
    errno = 0;
    const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), file_);
    if (count < bytes.size() && std::feof(file_) == 0) error_ = errno == 0 ? EIO : errno;
    return count;
}

}  // namespace espalier::tools
