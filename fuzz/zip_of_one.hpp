// A zip archive of one file, unpacked: a fuzzer that changes an archive itself fails at its checksum.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace espalier::fuzz {

inline std::uint32_t zip_checksum(std::string_view bytes) {
    std::uint32_t sum = ~0u;
    for (const char byte : bytes) {
        sum ^= static_cast<unsigned char>(byte);
        for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ ((sum & 1) != 0 ? 0xEDB88320u : 0u);
    }
    return ~sum;
}

inline std::string zip_of_one(std::string_view name, std::string_view bytes) {
    const auto number = [](std::uint64_t value, int size) {
        std::string result;
        for (int i = 0; i < size; ++i, value >>= 8) result += static_cast<char>(value & 0xFF);
        return result;
    };
    const std::string sizes = number(zip_checksum(bytes), 4) + number(bytes.size(), 4) + number(bytes.size(), 4);
    const std::string header = "PK\3\4" + number(20, 2) + number(0, 8) + sizes + number(name.size(), 2) + number(0, 2);
    const std::string file = header + std::string(name) + std::string(bytes);
    const std::string entry =
        "PK\1\2" + number(20, 2) + number(20, 2) + number(0, 8) + sizes + number(name.size(), 2) + number(0, 16);
    const std::string directory = entry + std::string(name);
    return file + directory + "PK\5\6" + number(0, 4) + number(1, 2) + number(1, 2) + number(directory.size(), 4) +
           number(file.size(), 4) + number(0, 2);
}

}  // namespace espalier::fuzz
