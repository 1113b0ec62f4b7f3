#include "memory.hpp"

#include <new>

#include <sys/mman.h>

namespace espalier::bench {
namespace {

constexpr std::size_t alignment = std::size_t{1} << 21;

}  // namespace

Memory::Memory(std::size_t size, Pages pages) : mapped_((size + 2 * alignment - 1) / alignment * alignment) {
    mapping_ = mmap(nullptr, mapped_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapping_ == MAP_FAILED) throw std::bad_alloc();
    const std::size_t offset = (alignment - reinterpret_cast<std::uintptr_t>(mapping_) % alignment) % alignment;
    data_ = static_cast<std::byte*>(mapping_) + offset;
#if defined(MADV_NOHUGEPAGE)
    // Refused where there are none.
    madvise(data_, mapped_ - offset, pages == Pages::huge ? MADV_HUGEPAGE : MADV_NOHUGEPAGE);
#endif
}

Memory::Memory(Memory&& other) noexcept
    : mapping_(std::exchange(other.mapping_, nullptr)), mapped_(other.mapped_), data_(other.data_) {}

Memory::~Memory() {
    if (mapping_ != nullptr) munmap(mapping_, mapped_);
}

}  // namespace espalier::bench
