#include <import/base/gzip.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <new>

#include <zlib.h>

#include <import/base/error.hpp>

namespace espalier::importer {

namespace {

constexpr int with_gzip_header = MAX_WBITS + 16;
constexpr std::size_t unpacked_bytes = std::size_t{1} << 16;

/// The parts of a file, each packed for itself, follow each other; zero bytes may fill a block at the end.
class Unpacker {
public:
    Unpacker(const std::string& path, std::string_view packed) : path_(path), rest_(packed) {
        if (inflateInit2(&stream_, with_gzip_header) != Z_OK) throw std::bad_alloc();
    }
    Unpacker(const Unpacker&) = delete;
    Unpacker& operator=(const Unpacker&) = delete;
    ~Unpacker() { inflateEnd(&stream_); }

    /// Returns false at the end.
    bool append_to(std::string& unpacked) {
        if (at_end_) {
            rest_.remove_prefix(std::min(rest_.find_first_not_of('\0'), rest_.size()));
            if (rest_.empty()) return false;
            if (!is_gzip(rest_)) fail();
            inflateReset(&stream_);
        }
        std::array<char, unpacked_bytes> step;
        const auto in = static_cast<uInt>(std::min<std::size_t>(rest_.size(), std::numeric_limits<uInt>::max()));
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest_.data()));  // which zlib only reads
        stream_.avail_in = in;
        stream_.next_out = reinterpret_cast<Bytef*>(step.data());
        stream_.avail_out = static_cast<uInt>(step.size());
        const int status = inflate(&stream_, Z_NO_FLUSH);
        if (status == Z_MEM_ERROR) throw std::bad_alloc();
        if (status != Z_OK && status != Z_STREAM_END) fail();  // Z_BUF_ERROR: it is cut off
        rest_.remove_prefix(in - stream_.avail_in);
        unpacked.append(step.data(), step.size() - stream_.avail_out);
        at_end_ = status == Z_STREAM_END;
        return true;
    }

private:
    [[noreturn]] void fail() const {
        throw_file_error(ImportStatus::invalid_input, path_,
                         " is packed by gzip, and is damaged or cut off. Copy or pack it again.");
    }

    const std::string& path_;
    std::string_view rest_;
    z_stream stream_{};
    bool at_end_ = false;
};

}  // namespace

std::string unpack_gzip(const std::string& path, std::string_view packed, std::size_t most) {
    Unpacker unpacker(path, packed);
    std::string unpacked;
    while (unpacked.size() < most && unpacker.append_to(unpacked)) {
    }
    unpacked.resize(std::min(unpacked.size(), most));
    return unpacked;
}

}  // namespace espalier::importer
