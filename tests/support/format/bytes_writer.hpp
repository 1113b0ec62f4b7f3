// Numbers into the bytes of a blob, for the encoder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace espalier::tests::encoding {

class Writer {
public:
    void put(std::uint64_t value, unsigned size) {
        for (unsigned i = 0; i < size; ++i) bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
    }
    void pad_to(std::size_t multiple) {
        while (bytes.size() % multiple != 0) bytes.push_back(std::byte{0});
    }
    /// A bit at a time, low bits first; `end_stream` fills the last byte up.
    void put_bits(std::uint64_t value, unsigned width) {
        for (unsigned i = 0; i < width; ++i, ++bit_) {
            if (bit_ % 8 == 0) bytes.push_back(std::byte{0});
            bytes.back() |= static_cast<std::byte>((value >> i & 1u) << (bit_ % 8));
        }
    }
    void end_stream() { bit_ = 0; }
    void append(const Writer& other) { bytes.insert(bytes.end(), other.bytes.begin(), other.bytes.end()); }

    std::vector<std::byte> bytes;

private:
    std::size_t bit_ = 0;
};

inline unsigned bits_for(std::uint32_t number) {
    unsigned count = 0;
    for (; number != 0; number /= 2) ++count;
    return count;
}

}  // namespace espalier::tests::encoding
