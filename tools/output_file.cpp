#include "output_file.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "exit_code.hpp"
#include "numbers.hpp"

namespace espalier::tools {

namespace {

[[noreturn]] void fail(const std::string& path, int error) {
    throw CommandError(ExitCode::file_access,
                       text("cannot write '", printable(path), "': ", std::strerror(error),
                            ". This file was not written; check the folder, its rights and the space on the disk."),
                       {.file = path});
}

/// Holds back the signals that end a program, so that an interrupt leaves no temporary behind.
class SignalsHeldBack {
public:
    SignalsHeldBack() {
        sigset_t held;
        sigemptyset(&held);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) sigaddset(&held, signal);
        pthread_sigmask(SIG_BLOCK, &held, &before_);
    }
    ~SignalsHeldBack() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    SignalsHeldBack(const SignalsHeldBack&) = delete;
    SignalsHeldBack& operator=(const SignalsHeldBack&) = delete;

private:
    sigset_t before_;
};

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
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) return errno;
    const int error = write_all(descriptor, bytes);
    return ::close(descriptor) != 0 && error == 0 ? errno : error;
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

int replace_file(const std::filesystem::path& target, std::span<const std::byte> bytes) {
    const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
    std::string temporary = (folder / text('.', target.filename().string(), ".XXXXXX")).string();
    const int descriptor = ::mkostemp(temporary.data(), O_CLOEXEC);
    if (descriptor < 0) return errno;
    int error = write_all(descriptor, bytes);
    if (error == 0 && ::fchmod(descriptor, rights_for_new_files()) != 0) error = errno;
    if (error == 0 && ::fsync(descriptor) != 0) error = errno;
    if (::close(descriptor) != 0 && error == 0) error = errno;
    if (error == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
    if (error != 0) {
        ::unlink(temporary.c_str());
        return error;
    }
    flush_folder(folder);
    return 0;
}

}  // namespace

void write_output_file(const std::string& path, std::span<const std::byte> bytes) {
    const SignalsHeldBack held_back;
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (std::filesystem::is_directory(status)) fail(path, EISDIR);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        if (const int failure = write_directly(path, bytes); failure != 0) fail(path, failure);
        return;
    }
    const std::filesystem::path target =
        std::filesystem::exists(status) ? std::filesystem::canonical(path, error) : std::filesystem::path(path);
    if (error && std::filesystem::exists(status)) fail(path, error.value());
    if (const int failure = replace_file(target, bytes); failure != 0) fail(path, failure);
}

void write_output_file_if_changed(const std::string& path, std::span<const std::byte> bytes) {
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error)) {
        std::ifstream file(path, std::ios::binary);
        const std::string before{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
        const auto old_bytes = std::as_bytes(std::span(before));
        if (file && std::equal(bytes.begin(), bytes.end(), old_bytes.begin(), old_bytes.end())) return;
    }
    write_output_file(path, bytes);
}

void refuse_to_overwrite_input(std::span<const NamedOutput> outputs, const std::string& input) {
    for (const NamedOutput& output : outputs) {
        std::error_code error;
        if (!std::filesystem::equivalent(output.path, input, error) || error) continue;
        if (!std::filesystem::is_regular_file(output.path, error)) continue;
        throw CommandError(ExitCode::usage,
                           text("the output '", printable(output.path), "' is the input '", printable(input),
                                "' itself, which it would replace. Give another name to ", output.option, "."),
                           {.file = output.path});
    }
}

void refuse_one_file_for_two(std::span<const NamedOutput> outputs) {
    std::error_code error;
    const auto place = [&error](const std::string& path) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(path), error);
    };
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        for (const NamedOutput& other : outputs.first(i)) {
            const NamedOutput& output = outputs[i];
            if (output.path.empty() || other.path.empty()) continue;
            if (place(output.path) != place(other.path) && !std::filesystem::equivalent(output.path, other.path, error))
                continue;
            if (std::filesystem::exists(output.path, error) && !std::filesystem::is_regular_file(output.path, error))
                continue;
            throw CommandError(ExitCode::usage,
                               text(output.option, " and ", other.option, " name the same file. Give each its own."));
        }
    }
}

}  // namespace espalier::tools
