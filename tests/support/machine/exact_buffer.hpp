// A heap block that ends exactly where its bytes end, so that the address sanitizer sees a read of one byte too many.
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <span>

namespace espalier::tests {

class ExactBuffer {
public:
    /// A copy of `bytes`, `misalignment` bytes past the block's start (which the heap aligns to 16).
    explicit ExactBuffer(std::span<const std::byte> bytes, std::size_t misalignment = 0)
        : block_(new std::byte[misalignment + bytes.size()]), misalignment_(misalignment), size_(bytes.size()) {
        if (!bytes.empty()) std::memcpy(block_.get() + misalignment, bytes.data(), bytes.size());
    }

    [[nodiscard]] std::span<std::byte> bytes() { return {block_.get() + misalignment_, size_}; }
    [[nodiscard]] std::span<const std::byte> bytes() const { return {block_.get() + misalignment_, size_}; }

private:
    std::unique_ptr<std::byte[]> block_;
    std::size_t misalignment_;
    std::size_t size_;
};

}  // namespace espalier::tests
