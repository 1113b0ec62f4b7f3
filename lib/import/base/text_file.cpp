#include <import/base/text_file.hpp>

#include <charconv>
#include <filesystem>
#include <limits>
#include <span>

#include <import/base/error.hpp>
#include <import/base/gzip.hpp>
#include <import/platform/files.hpp>

namespace espalier::importer {

namespace {

bool is_space(char character) {
    return character == ' ' || character == '\t' || character == '\v' || character == '\f';
}

void append_utf8(std::string& text, std::uint32_t code) {
    const auto append = [&text](std::uint32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
    if (code < 0x80) {
        append(code);
    } else if (code < 0x800) {
        append(0xC0 | code >> 6);
        append(0x80 | (code & 0x3F));
    } else if (code < 0x10000) {
        append(0xE0 | code >> 12);
        append(0x80 | (code >> 6 & 0x3F));
        append(0x80 | (code & 0x3F));
    } else {
        append(0xF0 | code >> 18);
        append(0x80 | (code >> 12 & 0x3F));
        append(0x80 | (code >> 6 & 0x3F));
        append(0x80 | (code & 0x3F));
    }
}

/// `bytes` begins with the mark of its byte order. Half a surrogate pair becomes a replacement character.
std::string from_utf16(std::string_view bytes) {
    const bool little = bytes[0] == '\xFF';
    const auto unit = [&](std::size_t at) {
        const auto first = static_cast<unsigned char>(bytes[at]);
        const auto second = static_cast<unsigned char>(bytes[at + 1]);
        return static_cast<std::uint32_t>(little ? second << 8 | first : first << 8 | second);
    };
    std::string text;
    text.reserve(bytes.size() / 2);
    for (std::size_t at = 2; at + 1 < bytes.size(); at += 2) {
        std::uint32_t code = unit(at);
        if ((code & 0xFC00) == 0xD800 && at + 3 < bytes.size() && (unit(at + 2) & 0xFC00) == 0xDC00) {
            code = 0x10000 + ((code & 0x3FF) << 10) + (unit(at + 2) & 0x3FF);
            at += 2;
        } else if ((code & 0xF800) == 0xD800) {
            code = 0xFFFD;
        }
        append_utf8(text, code);
    }
    return text;
}

/// Returns how many bytes the first character of a text has, or 0 when it is none of UTF-8.
std::size_t first_character_bytes(std::string_view text) {
    const auto first = static_cast<unsigned char>(text[0]);
    if (first < 0x80) return 1;
    const std::size_t count = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4 || text.size() < count) return 0;
    for (std::size_t i = 1; i < count; ++i)
        if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) return 0;
    // Longer than needed, half a surrogate pair, or beyond U+10FFFF.
    const auto second = static_cast<unsigned char>(text[1]);
    const bool is_none = (first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
                         (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F);
    return is_none ? 0 : count;
}

/// std::from_chars reads no sign +.
std::string_view without_plus(std::string_view word) {
    return word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+' ? word.substr(1) : word;
}

template <class Number>
std::errc parse(std::string_view word, Number& number) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return end == word.data() + word.size() ? error : std::errc::invalid_argument;
}

/// Returns the value of a decimal that is out of the range of double: infinity, or zero if its first digit other than 0
/// is far behind the point.
double beyond_double(std::string_view decimal) {
    const std::size_t end = std::min(decimal.find_first_of("eE"), decimal.size());
    const auto point = static_cast<std::int64_t>(std::min(decimal.find('.'), end));
    const auto first = static_cast<std::int64_t>(std::min(decimal.find_first_of("123456789"), end));
    const std::int64_t exponent = end == decimal.size() ? 0 : parse_integer(decimal.substr(end + 1)).value_or(0);
    const double size = exponent > first - point ? std::numeric_limits<double>::infinity() : 0.0;
    return decimal[0] == '-' ? -size : size;
}

/// All bytes of a file, packed or not.
template <class Bytes>
Bytes read_packed(const std::string& path) {
    Bytes bytes;
    if (const int error = read_whole_file(path_of(path), bytes); error != 0) fail_to_read(path, error);
    return bytes;
}

}  // namespace

std::string ending_of(const std::string& path) {
    const std::filesystem::path name = path_of(path);
    const std::string ending = lower_case(text_of(name.extension()));
    return ending == ".gz" ? lower_case(text_of(name.stem().extension())) : ending;
}

std::string read_begin(const std::string& path, std::size_t most) {
    std::string begin(most, '\0');
    InputFile file(path_of(path));
    begin.resize(file.read(std::as_writable_bytes(std::span(begin))));
    if (file.error() != 0) fail_to_read(path, file.error());
    return is_gzip(begin) ? unpack_gzip(path, read_packed<std::string>(path), most) : begin;
}

std::string read_bytes(const std::string& path) {
    auto bytes = read_packed<std::string>(path);
    return is_gzip(bytes) ? unpack_gzip(path, bytes, bytes.max_size()) : bytes;
}

std::vector<std::byte> read_byte_list(const std::string& path) {
    auto bytes = read_packed<std::vector<std::byte>>(path);
    const std::string_view packed(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (!is_gzip(packed)) return bytes;
    const std::string unpacked = unpack_gzip(path, packed, packed.max_size());
    const auto list = std::as_bytes(std::span(unpacked));
    bytes.assign(list.begin(), list.end());
    return bytes;
}

std::string utf8_text(std::string bytes) {
    if (bytes.starts_with("\xEF\xBB\xBF")) return bytes.substr(3);
    if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) return from_utf16(bytes);
    return bytes;
}

std::string utf8_name(std::string_view bytes) {
    std::string name;
    std::size_t begin = 0, end = 0;  // of what is UTF-8 and not yet in the name
    while (end < bytes.size()) {
        const std::size_t count = first_character_bytes(bytes.substr(end));
        end += count;
        if (count > 0) continue;
        name.append(bytes.substr(begin, end - begin));
        append_utf8(name, 0xFFFD);
        begin = ++end;
    }
    return name.append(bytes.substr(begin));
}

void refuse_line(const std::string& path, std::uint64_t line, const std::string& problem) {
    throw_file_error(ImportStatus::invalid_input, path, ", line ", line, ": ", problem);
}

bool Lines::next(std::string_view& line) {
    if (begin_ >= text_.size()) return false;
    if (!searched_ || line_feed_ < begin_) {
        line_feed_ = std::min(text_.find('\n', begin_), text_.size());
        searched_ = true;
    }
    line = text_.substr(begin_, line_feed_ - begin_);
    const std::size_t carriage_return = line.find('\r');
    if (carriage_return != std::string_view::npos && carriage_return + 1 < line.size()) {
        begin_ += carriage_return + 1;
    } else {  // LF or CR LF
        begin_ = std::min(line_feed_ + 1, text_.size());
    }
    line = line.substr(0, carriage_return);
    ++number_;
    return true;
}

/// Spaces at the end are left out here, once: a line may have a million of them.
Words::Words(std::string_view line) : rest_(line) {
    while (!rest_.empty() && is_space(rest_.back())) rest_.remove_suffix(1);
}

std::string_view Words::next() {
    std::size_t begin = 0;
    while (begin < rest_.size() && is_space(rest_[begin])) ++begin;
    std::size_t end = begin;
    while (end < rest_.size() && !is_space(rest_[end])) ++end;
    const std::string_view word = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    return word;
}

std::string_view Words::rest() const {
    std::string_view result = rest_;
    while (!result.empty() && is_space(result.front())) result.remove_prefix(1);
    return result;
}

std::optional<double> parse_coordinate(std::string_view word) {
    word = without_plus(word);
    double value = 0.0;
    const std::errc error = parse(word, value);
    if (error == std::errc()) return value;
    if (error != std::errc::result_out_of_range) return std::nullopt;
    return beyond_double(word);
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
    word = without_plus(word);
    std::int64_t value = 0;
    const std::errc error = parse(word, value);
    if (error == std::errc()) return value;
    if (error != std::errc::result_out_of_range) return std::nullopt;
    return word[0] == '-' ? std::numeric_limits<std::int64_t>::min() : std::numeric_limits<std::int64_t>::max();
}

}  // namespace espalier::importer
