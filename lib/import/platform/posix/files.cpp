#include <import/platform/files.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <system_error>

#include <import/platform/process.hpp>

namespace espalier::importer {

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

}  // namespace

std::filesystem::path path_of(std::string_view text) { return {text}; }

std::string text_of(const std::filesystem::path& path) { return path.string(); }

InputFile::InputFile(const std::filesystem::path& path) : file_(std::fopen(path.c_str(), "rb")) {
    if (file_ == nullptr) error_ = errno;
}

std::uint64_t InputFile::size() const {
    struct stat facts {};
    const bool is_known = file_ != nullptr && ::fstat(::fileno(file_), &facts) == 0 && S_ISREG(facts.st_mode);
    return is_known ? static_cast<std::uint64_t>(facts.st_size) : 0;
}

/// The file need not exist: a link to a place where there is none yet is followed, too.
int follow_links(const std::filesystem::path& path, std::filesystem::path& target) {
    constexpr int most_links = 40;
    target = path;
    for (int links = 0; links < most_links; ++links) {
        std::error_code error;
        if (!std::filesystem::is_symlink(std::filesystem::symlink_status(target, error))) return 0;
        const std::filesystem::path next = std::filesystem::read_symlink(target, error);
        if (error) return error.value();
        target = target.parent_path() / next;
    }
    return ELOOP;
}

int write_temporary(const std::filesystem::path& target, std::span<const std::byte> bytes,
                    std::filesystem::path& temporary) {
    temporary.clear();
    std::string name = (folder_of(target) / ('.' + target.filename().string() + ".XXXXXX")).string();
    const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor < 0) return errno;
    int error = write_all(descriptor, bytes);
    if (error == 0 && ::fchmod(descriptor, rights_for_new_files()) != 0) error = errno;
    if (error == 0 && ::fsync(descriptor) != 0) error = errno;
    if (::close(descriptor) != 0 && error == 0) error = errno;
    if (error == 0) {
        temporary = name;
    } else {
        ::unlink(name.c_str());
    }
    return error;
}

int replace_file(const std::filesystem::path& target, const std::filesystem::path& temporary) {
    if (::rename(temporary.c_str(), target.c_str()) != 0) return errno;
    flush_folder(folder_of(target));
    return 0;
}

int write_directly(const std::string& path, std::span<const std::byte> bytes) {
    if (is_standard_output(path)) return write_all(STDOUT_FILENO, bytes);
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) return errno;
    const int error = write_all(descriptor, bytes);
    return ::close(descriptor) != 0 && error == 0 ? errno : error;
}

int error_of_writing_to(const std::string& path) { return ::access(path.c_str(), W_OK) != 0 ? errno : 0; }

/// The right to do so is that of the folder, in which write_temporary() makes a file.
int error_of_replacing(const std::filesystem::path&) { return 0; }

}  // namespace espalier::importer
