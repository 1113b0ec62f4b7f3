// Paths as text, files to read, and bytes to files: temporaries that take the place of a file, and what is written
// where it is. A stream of C++ may take an error in the middle of a file for its end; these do not. Errors are values
// of errno.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace espalier::importer {

/// Returns the path that the text names. std::filesystem::path(text) depends on settings of the machine on Windows.
/// There, bytes that are no UTF-8 become U+FFFD, so that they name no file.
std::filesystem::path path_of(std::string_view text);
/// Returns the text of a path.
std::string text_of(const std::filesystem::path& path);

/// A file that is open for reading, from its start on.
class InputFile {
public:
    /// Takes the standard input.
    InputFile() : file_(stdin) {}
    /// Opens a file.
    explicit InputFile(const std::filesystem::path& path);
    ~InputFile() {
        if (file_ != nullptr && file_ != stdin) std::fclose(file_);
    }
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    /// Returns how many bytes the file states to have; 0 for what is no regular file.
    [[nodiscard]] std::uint64_t size() const;
    /// Reads the next bytes and returns their number: fewer than there is room for at the end of the file and at an
    /// error.
    std::size_t read(std::span<std::byte> bytes) {
        if (file_ == nullptr || error_ != 0) return 0;
        errno = 0;
        const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), file_);
        if (count < bytes.size() && std::feof(file_) == 0) error_ = errno == 0 ? EIO : errno;
        return count;
    }
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

/// Stores in `target` the file that a path names behind symbolic links. Returns 0 or an error.
int follow_links(const std::filesystem::path& path, std::filesystem::path& target);

/// Writes a new file in the folder of `target`, flushes it to the disk and stores its name in `temporary`. Returns 0,
/// or an error; then no file is left behind and `temporary` is empty.
int write_temporary(const std::filesystem::path& target, std::span<const std::byte> bytes,
                    std::filesystem::path& temporary);

/// Renames the temporary to `target`, which it replaces at once. Returns 0 or an error.
int replace_file(const std::filesystem::path& target, const std::filesystem::path& temporary);

/// Writes to a pipe or a device, or to the standard output where the path names it. Returns 0 or an error.
int write_directly(const std::string& path, std::span<const std::byte> bytes);

/// Returns 0 if this process may write to the pipe or device, else an error.
int error_of_writing_to(const std::string& path);

/// Returns 0 if another file may take the place of this one, as far as can be found before; else an error.
int error_of_replacing(const std::filesystem::path& target);

}  // namespace espalier::importer
