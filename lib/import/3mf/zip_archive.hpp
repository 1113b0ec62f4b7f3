// The files in a zip archive, as deflate packs them or unpacked, of any size.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace espalier::importer {

/// An archive in memory. Its names differ by more than capitals and the slash before them.
class ZipArchive {
public:
    /// `path` names it in messages. Throws ImportError (invalid_input) for bytes that are no zip archive, or a broken
    /// one.
    ZipArchive(std::string path, std::string bytes);

    /// Returns what two names have in common that name one file.
    [[nodiscard]] static std::string key_of(std::string_view name);

    [[nodiscard]] bool has(std::string_view name) const;
    /// Returns the unpacked bytes of a file in it. Throws ImportError: (invalid_input) for one that is missing,
    /// damaged or other than its sizes, (unsupported) for one that is encrypted or packed in another way.
    [[nodiscard]] std::string read(std::string_view name) const;

private:
    struct Entry {
        std::uint16_t flags = 0;
        std::uint16_t method = 0;
        std::uint32_t checksum = 0;
        std::uint64_t packed_bytes = 0;
        std::uint64_t bytes = 0;
        std::uint64_t header_at = 0;
    };
    /// Where the list of the files is.
    struct Directory {
        std::uint64_t at = 0;
        std::uint64_t bytes = 0;
        std::uint64_t entries = 0;
    };

    [[nodiscard]] Directory find_directory() const;
    void read_directory(const Directory& directory);
    void read_wide_sizes(std::string_view extra, Entry& entry) const;
    [[nodiscard]] std::string_view packed(const Entry& entry) const;
    void inflate_to(std::string& unpacked, std::string_view packed, std::string_view name) const;
    [[nodiscard]] std::string_view part(std::uint64_t at, std::uint64_t bytes) const;
    [[noreturn]] void fail(std::string_view problem) const;

    std::string path_;
    std::string bytes_;
    std::map<std::string, Entry, std::less<>> entries_;
};

}  // namespace espalier::importer
