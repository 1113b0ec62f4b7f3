// The parts of a file: numbers in its bytes, or lines, words and words as numbers. No locale changes what they mean.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::importer {

template <class Number>
Number stored_number(const char* bytes, std::endian order) {
    std::array<char, sizeof(Number)> copy;
    std::memcpy(copy.data(), bytes, sizeof(Number));
    if (order != std::endian::native) std::reverse(copy.begin(), copy.end());
    return std::bit_cast<Number>(copy);
}

template <class Number>
Number little_endian(const char* bytes) {
    return stored_number<Number>(bytes, std::endian::little);
}

/// Returns the ending of a file's name with its dot, in lower case, and without a ".gz" behind it; empty without one.
std::string ending_of(const std::string& path);

/// Return the first bytes of a file, at most so many, or all of them: those that gzip packed, unpacked. Throw
/// ImportError: (file_access) when it cannot be read, and as unpack_gzip() does.
std::string read_begin(const std::string& path, std::size_t most);
std::string read_bytes(const std::string& path);
std::vector<std::byte> read_byte_list(const std::string& path);

/// Returns the text without its byte order mark; UTF-16 with such a mark becomes UTF-8.
std::string utf8_text(std::string bytes);

/// Returns a name out of a file with U+FFFD in the place of each byte that is no part of UTF-8. All else stays, control
/// characters too.
std::string utf8_name(std::string_view bytes);

/// Throws ImportError (invalid_input): "'x.obj', line 12: PROBLEM".
[[noreturn]] void refuse_line(const std::string& path, std::uint64_t line, const std::string& problem);

/// The lines of a text, which end with LF, CR LF or CR. The text must outlive them.
class Lines {
public:
    explicit Lines(std::string_view text) : text_(text) {}

    /// Moves to the next line; returns false after the last one.
    bool next(std::string_view& line);
    /// The number of the line that `next` returned last, from 1.
    [[nodiscard]] std::uint64_t number() const { return number_; }
    /// Where the next line begins.
    [[nodiscard]] std::size_t offset() const { return begin_; }

private:
    std::string_view text_;
    std::size_t begin_ = 0;
    std::size_t line_feed_ = 0;  // the next one, once it was searched for
    bool searched_ = false;
    std::uint64_t number_ = 0;
};

/// The words of a line, separated by spaces and tabs.
class Words {
public:
    explicit Words(std::string_view line);

    /// Returns the next word, or an empty one after the last.
    std::string_view next();
    /// Returns what follows the words so far, without spaces around it.
    [[nodiscard]] std::string_view rest() const;

private:
    std::string_view rest_;
};

/// Returns the float64 nearest to a decimal such as "-1", "+.5", "1." or "1e5", "inf" and "nan" included; infinity
/// beyond the range of float64. Returns nothing for other words.
std::optional<double> parse_coordinate(std::string_view word);
/// Returns the number, or the nearest limit of its type for a larger one. Returns nothing for words that are no
/// integer.
std::optional<std::int64_t> parse_integer(std::string_view word);

}  // namespace espalier::importer
