// Numbers in bytes of a given order, at any address.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace espalier::tools {

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

}  // namespace espalier::tools
