// Reading numbers and bit fields, for the baker's own decoder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace espalier::baker {

[[nodiscard]] inline std::uint32_t read(std::span<const std::byte> bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
    return value;
}

/// Takes fields of any width up to 32 off the front of a stream.
class FieldReader {
public:
    explicit FieldReader(std::span<const std::byte> stream) : stream_(stream) {}

    std::uint32_t next(unsigned width) {
        while (available_ < width) {
            held_ |= std::to_integer<std::uint64_t>(stream_[at_++]) << available_;
            available_ += 8;
        }
        const auto field = static_cast<std::uint32_t>(held_ & ((std::uint64_t{1} << width) - 1));
        held_ >>= width;
        available_ -= width;
        return field;
    }

private:
    std::span<const std::byte> stream_;
    std::size_t at_ = 0;
    std::uint64_t held_ = 0;
    unsigned available_ = 0;
};

}  // namespace espalier::baker
