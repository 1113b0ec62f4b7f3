#include "output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "base/numbers.hpp"
#include "output_names.hpp"

namespace espalier::tools {

namespace {

int write_all(int descriptor, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return 0;
}

int write_directly(const std::string& path, std::span<const std::byte> bytes) {
    if (is_standard_output(path)) return write_all(STDOUT_FILENO, bytes);
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) return errno;
    const int error = write_all(descriptor, bytes);
    return ::close(descriptor) != 0 && error == 0 ? errno : error;
}

std::filesystem::path folder_of(const std::filesystem::path& target) {
    return target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
}

mode_t rights_for_new_files() {
    const mode_t mask = ::umask(0);
    ::umask(mask);
    return 0666 & ~mask;
}

/// The rename itself must survive a crash too. Not every file system can flush a folder; the data is safe either way.
void flush_folder(const std::filesystem::path& folder) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

/// Writes a temporary file in the folder of `target` and flushes it to the disk. Leaves none behind on failure.
int write_temporary(const std::filesystem::path& target, std::span<const std::byte> bytes, std::string& temporary) {
    temporary = (folder_of(target) / text('.', target.filename().string(), ".XXXXXX")).string();
    const int descriptor = ::mkostemp(temporary.data(), O_CLOEXEC);
    if (descriptor < 0) {
        temporary.clear();
        return errno;
    }
    int error = write_all(descriptor, bytes);
    if (error == 0 && ::fchmod(descriptor, rights_for_new_files()) != 0) error = errno;
    if (error == 0 && ::fsync(descriptor) != 0) error = errno;
    if (::close(descriptor) != 0 && error == 0) error = errno;
    if (error == 0) return 0;
    ::unlink(temporary.c_str());
    temporary.clear();
    return error;
}

}  // namespace

OutputFiles::OutputFiles() {
    sigset_t held;
    sigemptyset(&held);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) sigaddset(&held, signal);
    pthread_sigmask(SIG_BLOCK, &held, &signals_before_);
}

OutputFiles::~OutputFiles() {
    for (const Staged& file : staged_)
        if (!file.temporary.empty()) ::unlink(file.temporary.c_str());
    pthread_sigmask(SIG_SETMASK, &signals_before_, nullptr);
}

void OutputFiles::add(const std::string& path, std::span<const std::byte> bytes) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (std::filesystem::is_directory(status)) fail_to_write(path, EISDIR);
    Staged file{path, path, {}, {}};
    if (is_standard_output(path) || (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))) {
        file.bytes = bytes;
    } else {
        if (std::filesystem::exists(status)) file.target = std::filesystem::canonical(path, error);
        if (error && std::filesystem::exists(status)) fail_to_write(path, error.value());
        if (const int failure = write_temporary(file.target, bytes, file.temporary); failure != 0)
            fail_to_write(path, failure);
    }
    staged_.push_back(std::move(file));
}

void OutputFiles::commit() {
    for (Staged& file : staged_) {
        if (file.temporary.empty()) {
            if (const int failure = write_directly(file.path, file.bytes); failure != 0)
                fail_to_write(file.path, failure);
            continue;
        }
        if (::rename(file.temporary.c_str(), file.target.c_str()) != 0) fail_to_write(file.path, errno);
        file.temporary.clear();
        flush_folder(folder_of(file.target));
    }
    staged_.clear();
}

void write_output_file(const std::string& path, std::span<const std::byte> bytes) {
    OutputFiles files;
    files.add(path, bytes);
    files.commit();
}

void write_output_file_if_changed(const std::string& path, std::span<const std::byte> bytes) {
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error) && !is_standard_output(path)) {
        std::ifstream file(path, std::ios::binary);
        const std::string before{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
        const auto old_bytes = std::as_bytes(std::span(before));
        if (file && std::equal(bytes.begin(), bytes.end(), old_bytes.begin(), old_bytes.end())) return;
    }
    write_output_file(path, bytes);
}

}  // namespace espalier::tools
