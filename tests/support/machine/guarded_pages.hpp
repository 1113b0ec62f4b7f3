// Memory that cannot be written and that ends at a page which cannot be read: reads past the end stop the program even
// where no sanitizer watches, and so does any write.
#pragma once

#include <cstddef>
#include <span>

namespace espalier::tests {

class GuardedPages {
public:
    /// A read-only copy whose last byte is the last readable one (at_end) or whose first byte is the first readable
    /// one.
    GuardedPages(std::span<const std::byte> bytes, bool at_end);
    ~GuardedPages();
    GuardedPages(const GuardedPages&) = delete;
    GuardedPages& operator=(const GuardedPages&) = delete;

    [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

private:
    std::byte* mapping_ = nullptr;
    std::size_t mapping_size_ = 0;
    std::span<const std::byte> bytes_;
};

}  // namespace espalier::tests
