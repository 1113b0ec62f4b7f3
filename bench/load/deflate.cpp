#include "deflate.hpp"

#include <stdexcept>

#ifdef ESPALIER_BENCH_ZLIB
#include <zlib.h>
#endif

namespace espalier::bench {

#ifdef ESPALIER_BENCH_ZLIB

std::optional<std::vector<std::byte>> deflate_bytes(std::span<const std::byte> bytes) {
    uLongf size = compressBound(bytes.size());
    std::vector<std::byte> compressed(size);
    if (compress2(reinterpret_cast<Bytef*>(compressed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                  bytes.size(), Z_BEST_COMPRESSION) != Z_OK)
        throw std::runtime_error("zlib cannot compress");
    compressed.resize(size);
    return compressed;
}

std::vector<std::byte> inflate_bytes(std::span<const std::byte> compressed, std::size_t size) {
    std::vector<std::byte> bytes(size);
    uLongf written = size;
    if (uncompress(reinterpret_cast<Bytef*>(bytes.data()), &written, reinterpret_cast<const Bytef*>(compressed.data()),
                   compressed.size()) != Z_OK ||
        written != size)
        throw std::runtime_error("zlib finds damaged bytes");
    return bytes;
}

#else

std::optional<std::vector<std::byte>> deflate_bytes(std::span<const std::byte>) { return std::nullopt; }
std::vector<std::byte> inflate_bytes(std::span<const std::byte>, std::size_t) {
    throw std::runtime_error("there is no zlib");
}

#endif

}  // namespace espalier::bench
