#include <import/3mf/zip_archive.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <new>
#include <utility>

#include <zlib.h>

#include <import/base/error.hpp>
#include <import/base/text_file.hpp>

namespace espalier::importer {

namespace {

constexpr std::size_t end_bytes = 22;  // of the record at the end, before a comment
constexpr std::size_t longest_comment = 0xFFFF;
constexpr std::size_t wide_locator_bytes = 20;
constexpr std::size_t wide_end_bytes = 56;
constexpr std::size_t entry_bytes = 46;        // of the directory, before its name
constexpr std::size_t file_header_bytes = 30;  // before its name
constexpr std::uint16_t in_wide = 0xFFFF;      // the number is in a field of 64 bits
constexpr std::uint32_t in_wide_32 = 0xFFFFFFFF;
constexpr std::uint16_t wide_sizes_id = 1;
constexpr std::uint16_t encrypted_flag = 1;
constexpr std::uint64_t most_inflated = 1032;  // bytes of one byte of deflate

/// The number at an offset of a record that is long enough.
template <class Number>
Number number_at(std::string_view record, std::size_t offset) {
    return little_endian<Number>(record.data() + offset);
}

}  // namespace

std::string ZipArchive::key_of(std::string_view name) {
    std::string key = lower_case(name);
    std::replace(key.begin(), key.end(), '\\', '/');
    return key.starts_with('/') ? key.substr(1) : key;
}

ZipArchive::ZipArchive(std::string path, std::string bytes) : path_(std::move(path)), bytes_(std::move(bytes)) {
    read_directory(find_directory());
}

bool ZipArchive::has(std::string_view name) const { return entries_.contains(key_of(name)); }

ZipArchive::Directory ZipArchive::find_directory() const {
    const std::size_t earliest = bytes_.size() - std::min(bytes_.size(), end_bytes + longest_comment);
    const std::size_t at = bytes_.rfind("PK\5\6");
    if (at == std::string::npos || at < earliest || bytes_.size() - at < end_bytes)
        fail("it is no zip archive, or is cut off: the record at its end is missing");
    const std::string_view end = part(at, end_bytes);
    Directory result{number_at<std::uint32_t>(end, 16), number_at<std::uint32_t>(end, 12),
                     number_at<std::uint16_t>(end, 10)};
    if (result.at != in_wide_32 && result.bytes != in_wide_32 && result.entries != in_wide) return result;
    if (at < wide_locator_bytes) return result;
    const std::string_view locator = part(at - wide_locator_bytes, wide_locator_bytes);
    if (!locator.starts_with("PK\6\7")) return result;
    const std::string_view wide = part(number_at<std::uint64_t>(locator, 8), wide_end_bytes);
    if (!wide.starts_with("PK\6\6")) fail("its second record at the end is missing");
    return {number_at<std::uint64_t>(wide, 48), number_at<std::uint64_t>(wide, 40), number_at<std::uint64_t>(wide, 32)};
}

void ZipArchive::read_directory(const Directory& directory) {
    std::string_view rest = part(directory.at, directory.bytes);
    std::uint64_t packed_bytes = 0;
    for (std::uint64_t i = 0; i < directory.entries; ++i) {
        if (rest.size() < entry_bytes || !rest.starts_with("PK\1\2")) fail("its list of files is broken");
        Entry entry{number_at<std::uint16_t>(rest, 8),  number_at<std::uint16_t>(rest, 10),
                    number_at<std::uint32_t>(rest, 16), number_at<std::uint32_t>(rest, 20),
                    number_at<std::uint32_t>(rest, 24), number_at<std::uint32_t>(rest, 42)};
        const std::size_t name_bytes = number_at<std::uint16_t>(rest, 28);
        const std::size_t extra_bytes = number_at<std::uint16_t>(rest, 30);
        const std::size_t all = entry_bytes + name_bytes + extra_bytes + number_at<std::uint16_t>(rest, 32);
        if (rest.size() < all) fail("its list of files is broken");
        const std::string_view name = rest.substr(entry_bytes, name_bytes);
        read_wide_sizes(rest.substr(entry_bytes + name_bytes, extra_bytes), entry);
        // Files that share bytes would unpack a small archive to any size.
        if (entry.packed_bytes > bytes_.size() - packed_bytes) fail("it is cut off, or files in it overlap");
        packed_bytes += entry.packed_bytes;
        if (!entries_.emplace(key_of(name), entry).second)
            fail(text("it has the file '", printable(name), "' twice, and only one of the two can count"));
        rest.remove_prefix(all);
    }
}

/// Sizes of 64 bits stand in a record of their own, each only if its field of 32 bits has no room for it.
void ZipArchive::read_wide_sizes(std::string_view extra, Entry& entry) const {
    while (extra.size() >= 4) {
        const auto id = number_at<std::uint16_t>(extra, 0);
        const auto bytes = number_at<std::uint16_t>(extra, 2);
        std::string_view record = extra.substr(4, bytes);
        extra.remove_prefix(std::min<std::size_t>(extra.size(), 4 + std::size_t{bytes}));
        if (id != wide_sizes_id) continue;
        for (std::uint64_t* number : {&entry.bytes, &entry.packed_bytes, &entry.header_at}) {
            if (*number != in_wide_32) continue;
            if (record.size() < 8) fail("its list of files is broken");
            *number = number_at<std::uint64_t>(record, 0);
            record.remove_prefix(8);
        }
    }
}

std::string ZipArchive::read(std::string_view name) const {
    const auto found = entries_.find(key_of(name));
    if (found == entries_.end()) fail(text("it lacks the file '", printable(name), "'"));
    const Entry& entry = found->second;
    if ((entry.flags & encrypted_flag) != 0) {
        throw_file_error(ImportStatus::unsupported, path_, ": the file '", printable(name),
                         "' in it is encrypted. Save it without a password.");
    }
    const std::string_view stored = packed(entry);
    std::string unpacked;
    if (entry.method == Z_DEFLATED) {
        // A small archive may claim any size: what its bytes cannot hold is refused before memory is taken.
        if (entry.bytes / most_inflated > stored.size())
            fail(text("the file '", printable(name), "' in it states more bytes than it can hold"));
        unpacked.resize(entry.bytes);
        inflate_to(unpacked, stored, name);
    } else if (entry.method == 0) {
        unpacked = stored;
    } else {
        throw_file_error(ImportStatus::unsupported, path_, ": the file '", printable(name),
                         "' in it is packed by method ", entry.method, ", and only deflate is read. Pack it again.");
    }
    if (unpacked.size() != entry.bytes ||
        crc32_z(0, reinterpret_cast<const Bytef*>(unpacked.data()), unpacked.size()) != entry.checksum)
        fail(text("the file '", printable(name), "' in it is damaged"));
    return unpacked;
}

std::string_view ZipArchive::packed(const Entry& entry) const {
    const std::string_view header = part(entry.header_at, file_header_bytes);
    if (!header.starts_with("PK\3\4")) fail("a file of it does not begin where its list states");
    const std::uint64_t names =
        std::uint64_t{number_at<std::uint16_t>(header, 26)} + number_at<std::uint16_t>(header, 28);
    return part(entry.header_at + file_header_bytes + names, entry.packed_bytes);
}

/// The size of `unpacked` is the one that is stated.
void ZipArchive::inflate_to(std::string& unpacked, std::string_view packed, std::string_view name) const {
    constexpr std::size_t most = std::numeric_limits<uInt>::max();
    z_stream stream{};
    if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw std::bad_alloc();
    const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, inflateEnd);
    std::size_t left_in = packed.size(), left_out = unpacked.size();
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));  // which zlib only reads
    stream.next_out = reinterpret_cast<Bytef*>(unpacked.data());
    int status = Z_OK;
    while (status == Z_OK) {
        const auto in = static_cast<uInt>(std::min(left_in, most));
        const auto out = static_cast<uInt>(std::min(left_out, most));
        stream.avail_in = in;
        stream.avail_out = out;
        status = inflate(&stream, Z_NO_FLUSH);
        left_in -= in - stream.avail_in;
        left_out -= out - stream.avail_out;
    }
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    if (status != Z_STREAM_END || left_out != 0) fail(text("the file '", printable(name), "' in it is damaged"));
}

std::string_view ZipArchive::part(std::uint64_t at, std::uint64_t bytes) const {
    if (at > bytes_.size() || bytes > bytes_.size() - at) fail("it is cut off, or its list of files is broken");
    return std::string_view(bytes_).substr(at, bytes);
}

void ZipArchive::fail(std::string_view problem) const {
    throw_file_error(ImportStatus::invalid_input, path_, " cannot be imported: ", problem,
                     ". Copy or export it again.");
}

}  // namespace espalier::importer
