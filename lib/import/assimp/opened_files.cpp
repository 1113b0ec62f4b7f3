#include <import/assimp/steps.hpp>

#include <assimp/DefaultIOSystem.h>
#include <assimp/IOStream.hpp>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <map>
#include <utility>

#include <import/base/gzip.hpp>
#include <import/base/text_file.hpp>
#include <import/platform/files.hpp>

namespace espalier::importer {

namespace {

/// A file in memory.
class StoredFile : public Assimp::IOStream {
public:
    explicit StoredFile(std::shared_ptr<const std::string> bytes) : bytes_(std::move(bytes)) {}
    std::size_t Read(void* target, std::size_t size, std::size_t count) override {
        const std::size_t left = bytes_->size() - std::min(at_, bytes_->size());
        if (size == 0 || left == 0) return 0;
        const std::size_t taken = count < left / size ? count * size : std::min(count * size, left);
        std::memcpy(target, bytes_->data() + at_, taken);
        at_ += taken;
        return taken / size;
    }
    std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
    aiReturn Seek(std::size_t offset, aiOrigin origin) override {
        at_ = offset + (origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : bytes_->size());
        return aiReturn_SUCCESS;
    }
    std::size_t Tell() const override { return at_; }
    std::size_t FileSize() const override { return bytes_->size(); }
    void Flush() override {}

private:
    std::shared_ptr<const std::string> bytes_;
    std::size_t at_ = 0;
};

class ListedFiles : public Assimp::DefaultIOSystem {
public:
    explicit ListedFiles(OpenedFiles& files) : files_(files) {}

    bool Exists(const char* name) const override {
        const char* const path = path_for(name);
        const bool exists = DefaultIOSystem::Exists(path) && !is_folder(path);
        if (!exists) list(path, files_.missing);
        return exists;
    }
    Assimp::IOStream* Open(const char* name, const char*) override {
        const char* const path = path_for(name);
        // A folder can be opened where the system is one of POSIX.
        const bool is_there = !is_folder(path) && InputFile(path_of(path)).error() == 0;
        list(path, is_there ? files_.opened : files_.missing);
        if (!is_there) return nullptr;
        std::shared_ptr<const std::string>& stored = stored_[path];
        if (stored == nullptr) stored = std::make_shared<const std::string>(content_of(path));
        return new StoredFile(stored);
    }

private:
    const char* path_for(const char* name) const { return files_.second_name == name ? files_.path.c_str() : name; }
    static bool is_folder(const char* path) {
        std::error_code error;
        return std::filesystem::is_directory(path_of(path), error);
    }
    static void list(const char* path, std::vector<std::string>& paths) {
        if (std::find(paths.begin(), paths.end(), path) == paths.end()) paths.emplace_back(path);
    }
    /// Errors are noted, because importers take them for the end of the file. A text that was stored as UTF-16, with a
    /// byte order mark and a letter of ASCII, becomes UTF-8: not all importers convert it.
    std::string content_of(const char* path) {
        std::string bytes;
        const int error = read_whole_file(path_of(path), bytes);
        if (error != 0 && files_.error == 0) {
            files_.unreadable = path;
            files_.error = error;
        }
        if (files_.path == path && is_gzip(bytes)) bytes = unpack_gzip(path, bytes, bytes.max_size());
        const bool is_little = bytes.starts_with("\xFF\xFE"), is_big = bytes.starts_with("\xFE\xFF");
        const bool is_letter =
            bytes.size() > 3 && (is_little ? bytes[2] != 0 && bytes[3] == 0 : bytes[2] == 0 && bytes[3] != 0);
        return (is_little || is_big) && is_letter ? utf8_text(std::move(bytes)) : bytes;
    }

    std::map<std::string, std::shared_ptr<const std::string>> stored_;  // importers open a file many times
    OpenedFiles& files_;
};

}  // namespace

std::unique_ptr<Assimp::IOSystem> list_opened_files(OpenedFiles& files) { return std::make_unique<ListedFiles>(files); }

}  // namespace espalier::importer
