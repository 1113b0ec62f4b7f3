// Files to read. A stream of C++ may take an error in the middle of a file for its end; these do not. Errors are values
// of errno.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <span>

namespace espalier::tools {

/// A file that is open for reading, from its start on.
class InputFile {
public:
    /// Takes the standard input.
    InputFile() : file_(stdin) {}
    /// Opens a file.
    explicit InputFile(const std::filesystem::path& path);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    /// Returns how many bytes the file states to have; 0 for what is no regular file.
    [[nodiscard]] std::uint64_t size() const;
    /// Reads the next bytes and returns their number: fewer than there is room for at the end of the file and at an
    /// error.
    std::size_t read(std::span<std::byte> bytes);
    /// Returns 0, or the error of opening or reading.
    [[nodiscard]] int error() const { return error_; }

private:
    std::FILE* file_;
    int error_ = 0;
};

/// Reads a whole file into a string or an array of bytes. Returns 0 or an error.
template <class Bytes>
int read_whole_file(const std::filesystem::path& path, Bytes& bytes) {
    constexpr std::size_t chunk = std::size_t{1} << 20;
    InputFile file(path);
    const std::uint64_t size = file.size();
    bytes.clear();
    std::size_t wanted = static_cast<std::size_t>(size) + 1;  // the last one finds the end
    for (bool goes_on = true; goes_on; wanted = chunk) {
        const std::size_t have = bytes.size();
        bytes.resize(have + wanted);
        const std::size_t count = file.read(std::as_writable_bytes(std::span(bytes)).subspan(have));
        bytes.resize(have + count);
        goes_on = count == wanted;
    }
    return file.error() == 0 && bytes.size() < size ? EIO : file.error();  // it became shorter meanwhile
}

}  // namespace espalier::tools
