#include "steps.hpp"

#include <assimp/DefaultIOSystem.h>
#include <assimp/IOStream.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "import/base/text_file.hpp"
#include "platform/input_file.hpp"
#include "platform/paths.hpp"

namespace espalier::tools {

namespace {

/// A text that was stored as UTF-16, as UTF-8: not all importers convert it.
class ConvertedStream : public Assimp::IOStream {
public:
    explicit ConvertedStream(std::string text) : text_(std::move(text)) {}
    std::size_t Read(void* target, std::size_t size, std::size_t count) override {
        if (size == 0) return 0;
        count = std::min(count, (text_.size() - at_) / size);
        std::memcpy(target, text_.data() + at_, count * size);
        at_ += count * size;
        return count;
    }
    std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
    aiReturn Seek(std::size_t offset, aiOrigin origin) override {
        const std::size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : text_.size();
        if (from + offset > text_.size()) return aiReturn_FAILURE;
        at_ = from + offset;
        return aiReturn_SUCCESS;
    }
    std::size_t Tell() const override { return at_; }
    std::size_t FileSize() const override { return text_.size(); }
    void Flush() override {}

private:
    std::string text_;
    std::size_t at_ = 0;
};

void note_failure(OpenedFiles& files, const std::string& path, int error) {
    if (files.error != 0) return;
    files.unreadable = path;
    files.error = error;
}

/// A stream whose errors are noted: importers take them for the end of the file.
class WatchedStream : public Assimp::IOStream {
public:
    WatchedStream(std::unique_ptr<Assimp::IOStream> stream, const char* path, OpenedFiles& files)
        : stream_(std::move(stream)), path_(path), files_(files) {}
    std::size_t Read(void* target, std::size_t size, std::size_t count) override {
        errno = 0;
        const std::size_t read = stream_->Read(target, size, count);
        const int error = errno;
        if (size != 0 && read < count && stream_->Tell() < stream_->FileSize())
            note_failure(files_, path_, error == 0 ? EIO : error);
        return read;
    }
    std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
    aiReturn Seek(std::size_t offset, aiOrigin origin) override { return stream_->Seek(offset, origin); }
    std::size_t Tell() const override { return stream_->Tell(); }
    std::size_t FileSize() const override { return stream_->FileSize(); }
    void Flush() override {}

private:
    std::unique_ptr<Assimp::IOStream> stream_;
    std::string path_;
    OpenedFiles& files_;
};

class ListedFiles : public Assimp::DefaultIOSystem {
public:
    explicit ListedFiles(OpenedFiles& files) : files_(files) {}

    bool Exists(const char* path) const override {
        const bool exists = DefaultIOSystem::Exists(path) && !is_folder(path);
        if (!exists) list(path, files_.missing);
        return exists;
    }
    Assimp::IOStream* Open(const char* path, const char* mode) override {
        // A folder can be opened where the system is one of POSIX.
        std::unique_ptr<Assimp::IOStream> stream(is_folder(path) ? nullptr : DefaultIOSystem::Open(path, mode));
        list(path, stream != nullptr ? files_.opened : files_.missing);
        if (stream == nullptr) return nullptr;
        auto watched = std::make_unique<WatchedStream>(std::move(stream), path, files_);
        if (!is_utf16(*watched)) return watched.release();
        std::string bytes;
        if (const int error = read_whole_file(path_of(path), bytes); error != 0) note_failure(files_, path, error);
        return new ConvertedStream(utf8_text(std::move(bytes)));
    }

private:
    static bool is_folder(const char* path) {
        std::error_code error;
        return std::filesystem::is_directory(path_of(path), error);
    }
    static void list(const char* path, std::vector<std::string>& paths) {
        if (std::find(paths.begin(), paths.end(), path) == paths.end()) paths.emplace_back(path);
    }
    /// A byte order mark and a letter of ASCII.
    static bool is_utf16(Assimp::IOStream& stream) {
        unsigned char begin[4] = {};
        const bool is_long = stream.Read(begin, 1, sizeof(begin)) == sizeof(begin);
        stream.Seek(0, aiOrigin_SET);
        return is_long && ((begin[0] == 0xFF && begin[1] == 0xFE && begin[2] != 0 && begin[3] == 0) ||
                           (begin[0] == 0xFE && begin[1] == 0xFF && begin[2] == 0 && begin[3] != 0));
    }

    OpenedFiles& files_;
};

}  // namespace

std::unique_ptr<Assimp::IOSystem> list_opened_files(OpenedFiles& files) { return std::make_unique<ListedFiles>(files); }

}  // namespace espalier::tools
