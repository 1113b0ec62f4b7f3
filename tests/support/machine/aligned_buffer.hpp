// Memory for a moving scene: a heap block that ends exactly where its bytes end, so that the address sanitizer sees a
// read of one byte too many.
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <span>

namespace espalier::tests {

class AlignedBuffer {
public:
    static constexpr std::size_t alignment = 32;

    /// Zeros, `misalignment` bytes past an address that the alignment divides.
    explicit AlignedBuffer(std::size_t size, std::size_t misalignment = 0)
        : block_(static_cast<std::byte*>(::operator new(misalignment + size, std::align_val_t(alignment)))),
          misalignment_(misalignment),
          size_(size) {
        std::memset(block_.get(), 0, misalignment + size);
    }
    /// A copy of the bytes.
    explicit AlignedBuffer(std::span<const std::byte> bytes, std::size_t misalignment = 0)
        : AlignedBuffer(bytes.size(), misalignment) {
        if (!bytes.empty()) std::memcpy(block_.get() + misalignment, bytes.data(), bytes.size());
    }

    [[nodiscard]] std::span<const std::byte> bytes() const { return {block_.get() + misalignment_, size_}; }
    [[nodiscard]] std::span<std::byte> bytes() { return {block_.get() + misalignment_, size_}; }

private:
    struct Free {
        void operator()(std::byte* block) const { ::operator delete(block, std::align_val_t(alignment)); }
    };
    std::unique_ptr<std::byte, Free> block_;
    std::size_t misalignment_;
    std::size_t size_;
};

}  // namespace espalier::tests
