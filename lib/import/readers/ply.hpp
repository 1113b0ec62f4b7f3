// A PLY file: its header, and the values after it, one after the other, as text or binary.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <import/base/error.hpp>
#include <import/base/text_file.hpp>

namespace espalier::importer {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

constexpr std::size_t size_of(PlyType type) {
    constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
}
constexpr bool is_integer(PlyType type) { return type < PlyType::float32; }

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::int8;
    std::optional<PlyType> count_type;  ///< of a list: the type of the number of its entries
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    [[nodiscard]] bool has_list() const;
    /// How many bytes one takes at least in the binary form; exactly so many without lists.
    [[nodiscard]] std::size_t least_bytes() const;
    [[nodiscard]] const PlyProperty* find(std::string_view property) const;
};

enum class PlyForm : std::uint8_t { text, little_endian, big_endian };

struct PlyHeader {
    PlyForm form = PlyForm::text;
    std::vector<PlyElement> elements;
    std::size_t bytes = 0;    ///< where the data begins
    std::uint64_t lines = 0;  ///< of the header
};

/// Throws ImportError (invalid_input) if the file is no PLY, or a line of the header is wrong.
PlyHeader read_ply_header(const std::string& path, std::string_view content);

/// Each element is a line.
class PlyText {
public:
    PlyText(const std::string& path, const PlyHeader& header, std::string_view content)
        : path_(&path), header_lines_(header.lines), lines_(content.substr(header.bytes)), content_(content) {}

    void begin_element(const PlyElement& element) {
        beyond_all_ = {};
        std::string_view line;
        words_ = Words({});
        while (lines_.next(line)) {
            words_ = Words(line);
            if (!words_.rest().empty()) return;
        }
        if (!element.properties.empty()) {
            refuse(text("the file ends before its last '", printable(element.name), "'. Is it whole?"));
        }
    }
    void end_element() {
        if (!words_.rest().empty()) {
            refuse(text("'", printable(words_.next().substr(0, 40)), "' follows the values that the header states."));
        }
    }
    double coordinate(PlyType) {
        const std::string_view word = next();
        const auto value = parse_coordinate(word);
        if (!value) refuse(text("'", printable(word.substr(0, 40)), "' is not a number."));
        return *value;
    }
    std::int64_t integer(PlyType) {
        const std::string_view word = next();
        const auto value = parse_integer(word);
        if (!value) refuse(text("'", printable(word.substr(0, 40)), "' is not an integer."));
        if (is_limit(*value) && beyond_all_.empty()) beyond_all_ = word;
        return *value;
    }
    /// Returns an integer of the line as the file writes it.
    [[nodiscard]] std::string written(std::int64_t value) const {
        return is_limit(value) ? std::string(beyond_all_) : text(value);
    }
    void skip(PlyType, std::uint64_t count) {
        for (std::uint64_t i = 0; i < count; ++i) next();
    }
    void skip_elements(const PlyElement& element) {
        if (element.properties.empty()) return;
        for (std::uint64_t i = 0; i < element.count; ++i) begin_element(element);
    }
    /// An upper bound of how many elements can follow.
    [[nodiscard]] std::uint64_t room_for(const PlyElement&) const { return content_.size() / 2 + 1; }
    [[nodiscard]] bool has_more() {
        for (std::string_view line; lines_.next(line);) {
            if (!Words(line).rest().empty()) return true;
        }
        return false;
    }
    [[nodiscard]] std::string place() const { return text("line ", header_lines_ + lines_.number()); }
    [[noreturn]] void refuse(const std::string& problem) const {
        refuse_line(*path_, header_lines_ + lines_.number(), problem);
    }

private:
    std::string_view next() {
        const std::string_view word = words_.next();
        if (word.empty()) refuse("the line has fewer values than the header states. Is the file whole?");
        return word;
    }

    using Limits = std::numeric_limits<std::int64_t>;
    /// What parse_integer() makes of numbers beyond its type.
    static bool is_limit(std::int64_t value) { return value == Limits::min() || value == Limits::max(); }

    const std::string* path_;
    std::uint64_t header_lines_;
    Lines lines_;
    std::string_view content_;
    Words words_{{}};
    std::string_view beyond_all_;  // the first integer of the line that is a limit
};

class PlyBytes {
public:
    PlyBytes(const std::string& path, const PlyHeader& header, std::string_view content)
        : path_(&path),
          order_(header.form == PlyForm::big_endian ? std::endian::big : std::endian::little),
          content_(content),
          at_(header.bytes) {}

    void begin_element(const PlyElement&) {}
    void end_element() {}
    double coordinate(PlyType type) {
        if (type == PlyType::float32) return double(take<float>());
        return type == PlyType::float64 ? take<double>() : static_cast<double>(integer(type));
    }
    std::int64_t integer(PlyType type) {
        if (type == PlyType::int8) return take<std::int8_t>();
        if (type == PlyType::uint8) return take<std::uint8_t>();
        if (type == PlyType::int16) return take<std::int16_t>();
        if (type == PlyType::uint16) return take<std::uint16_t>();
        if (type == PlyType::int32) return take<std::int32_t>();
        return take<std::uint32_t>();
    }
    [[nodiscard]] static std::string written(std::int64_t value) { return text(value); }
    void skip(PlyType type, std::uint64_t count) {
        require(count, size_of(type));
        at_ += static_cast<std::size_t>(count) * size_of(type);
    }
    void skip_elements(const PlyElement& element) {
        if (!element.has_list()) {
            require(element.count, element.least_bytes());
            at_ += static_cast<std::size_t>(element.count) * element.least_bytes();
            return;
        }
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const PlyProperty& property : element.properties) {
                std::int64_t count = 1;
                if (property.count_type) count = integer(*property.count_type);
                if (count < 0) refuse("a list has a negative length.");
                skip(property.type, static_cast<std::uint64_t>(count));
            }
        }
    }
    [[nodiscard]] std::uint64_t room_for(const PlyElement& element) const {
        return (content_.size() - at_) / std::max<std::size_t>(1, element.least_bytes());
    }
    [[nodiscard]] bool has_more() const { return content_.find_first_not_of(" \t\r\n", at_) != std::string_view::npos; }
    [[nodiscard]] std::string place() const { return text("byte ", at_); }
    [[noreturn]] void refuse(const std::string& problem) const {
        throw_file_error(ImportStatus::invalid_input, *path_, ", byte ", at_, ": ", problem);
    }

private:
    template <class Number>
    Number take() {
        require(1, sizeof(Number));
        const Number number = stored_number<Number>(content_.data() + at_, order_);
        at_ += sizeof(Number);
        return number;
    }
    void require(std::uint64_t count, std::size_t bytes) const {
        if (bytes > 0 && count > (content_.size() - at_) / bytes) {
            refuse(text("the file ends before the values that its header states. Is it whole?"));
        }
    }

    const std::string* path_;
    std::endian order_;
    std::string_view content_;
    std::size_t at_;
};

}  // namespace espalier::importer
