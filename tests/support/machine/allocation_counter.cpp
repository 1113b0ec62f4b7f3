#include "allocation_counter.hpp"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::uint64_t> allocations{0};
std::atomic<std::int64_t> live{0};
constexpr std::uint64_t never = ~std::uint64_t{0};
std::atomic<std::uint64_t> failing{never};  // the number of the allocation that fails

void* counted(void* block) {
    if (block != nullptr) live.fetch_add(1, std::memory_order_relaxed);
    return block;
}

bool fails_now() {
    return allocations.fetch_add(1, std::memory_order_relaxed) == failing.load(std::memory_order_relaxed);
}

void* count_and_allocate(std::size_t size) {
    if (fails_now()) return nullptr;
    return counted(std::malloc(size != 0 ? size : 1));
}

void* count_and_allocate(std::size_t size, std::align_val_t alignment) {
    if (fails_now()) return nullptr;
    void* block = nullptr;
    const std::size_t power = static_cast<std::size_t>(alignment);
    const int error = posix_memalign(&block, power < sizeof(void*) ? sizeof(void*) : power, size != 0 ? size : 1);
    return error == 0 ? counted(block) : nullptr;
}

void count_and_free(void* block) {
    if (block != nullptr) live.fetch_sub(1, std::memory_order_relaxed);
    std::free(block);
}

template <class... Arguments>
void* allocate_or_throw(Arguments... arguments) {
    void* block = count_and_allocate(arguments...);
    if (block == nullptr) throw std::bad_alloc();
    return block;
}

}  // namespace

void* operator new(std::size_t size) { return allocate_or_throw(size); }
void* operator new[](std::size_t size) { return allocate_or_throw(size); }
void* operator new(std::size_t size, std::align_val_t alignment) { return allocate_or_throw(size, alignment); }
void* operator new[](std::size_t size, std::align_val_t alignment) { return allocate_or_throw(size, alignment); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return count_and_allocate(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return count_and_allocate(size); }
void operator delete(void* block) noexcept { count_and_free(block); }
void operator delete[](void* block) noexcept { count_and_free(block); }
void operator delete(void* block, std::size_t) noexcept { count_and_free(block); }
void operator delete[](void* block, std::size_t) noexcept { count_and_free(block); }
void operator delete(void* block, std::align_val_t) noexcept { count_and_free(block); }
void operator delete[](void* block, std::align_val_t) noexcept { count_and_free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { count_and_free(block); }
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept { count_and_free(block); }
void operator delete(void* block, const std::nothrow_t&) noexcept { count_and_free(block); }
void operator delete[](void* block, const std::nothrow_t&) noexcept { count_and_free(block); }

namespace espalier::tests {

std::uint64_t allocation_count() { return allocations.load(std::memory_order_relaxed); }

std::int64_t live_allocations() { return live.load(std::memory_order_relaxed); }

FailingAllocation::FailingAllocation(std::uint64_t before_it) : number_(allocation_count() + before_it) {
    failing.store(number_, std::memory_order_relaxed);
}
FailingAllocation::~FailingAllocation() { failing.store(never, std::memory_order_relaxed); }
bool FailingAllocation::was_reached() const { return allocation_count() > number_; }

}  // namespace espalier::tests
