// Moves fields between records, as the functions of C read and write them, and arrays with one field each, as
// JavaScript has them.
#include <cstddef>
#include <cstring>

namespace {

template <std::size_t Bytes>
void copy_each(const std::byte* from, std::ptrdiff_t from_stride, std::byte* to, std::ptrdiff_t to_stride,
               std::size_t count) {
    for (std::size_t i = 0; i < count; ++i, from += from_stride, to += to_stride) std::memcpy(to, from, Bytes);
}

}  // namespace

/// Copies `count` fields of `bytes` bytes. A stride of 0 reads the same field for all.
extern "C" [[clang::export_name("wasm_copy_fields")]] void wasm_copy_fields(const std::byte* from,
                                                                            std::ptrdiff_t from_stride, std::byte* to,
                                                                            std::ptrdiff_t to_stride, std::size_t bytes,
                                                                            std::size_t count) {
    switch (bytes) {
        case 1:
            return copy_each<1>(from, from_stride, to, to_stride, count);
        case 4:
            return copy_each<4>(from, from_stride, to, to_stride, count);
        case 12:
            return copy_each<12>(from, from_stride, to, to_stride, count);
        default:
            for (std::size_t i = 0; i < count; ++i, from += from_stride, to += to_stride) std::memcpy(to, from, bytes);
    }
}
