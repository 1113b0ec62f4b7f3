#include "opened_files.hpp"

#include <assimp/DefaultIOSystem.h>
#include <assimp/IOStream.hpp>

#include <algorithm>
#include <cstring>
#include <utility>

#include "import/base/text_file.hpp"

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

class ListedFiles : public Assimp::DefaultIOSystem {
public:
    ListedFiles(std::vector<std::string>& opened, std::vector<std::string>& missing)
        : opened_(opened), missing_(missing) {}

    bool Exists(const char* path) const override {
        const bool exists = DefaultIOSystem::Exists(path);
        if (!exists) list(path, missing_);
        return exists;
    }
    Assimp::IOStream* Open(const char* path, const char* mode) override {
        Assimp::IOStream* stream = DefaultIOSystem::Open(path, mode);
        list(path, stream != nullptr ? opened_ : missing_);
        if (stream == nullptr || !is_utf16(*stream)) return stream;
        Close(stream);
        return new ConvertedStream(utf8_text(read_bytes(path)));
    }

private:
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

    std::vector<std::string>& opened_;
    std::vector<std::string>& missing_;
};

}  // namespace

std::unique_ptr<Assimp::IOSystem> list_opened_files(std::vector<std::string>& opened,
                                                    std::vector<std::string>& missing) {
    return std::make_unique<ListedFiles>(opened, missing);
}

}  // namespace espalier::tools
