#include "guarded_pages.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstring>
#include <stdexcept>

namespace espalier::tests {

GuardedPages::GuardedPages(std::span<const std::byte> bytes, bool at_end) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t inside = (bytes.size() + page - 1) / page * page;
    mapping_size_ = inside + 2 * page;
    void* mapping = mmap(nullptr, mapping_size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapping == MAP_FAILED) throw std::runtime_error("mmap failed");
    mapping_ = static_cast<std::byte*>(mapping);
    std::byte* const first = mapping_ + page;
    std::byte* const place = at_end ? first + inside - bytes.size() : first;
    if (!bytes.empty()) std::memcpy(place, bytes.data(), bytes.size());
    bytes_ = {place, bytes.size()};
    bool guarded = mprotect(mapping_, page, PROT_NONE) == 0 && mprotect(first + inside, page, PROT_NONE) == 0;
    if (inside != 0) guarded = guarded && mprotect(first, inside, PROT_READ) == 0;
    if (!guarded) {
        munmap(mapping_, mapping_size_);
        throw std::runtime_error("mprotect failed");
    }
}

GuardedPages::~GuardedPages() { munmap(mapping_, mapping_size_); }

}  // namespace espalier::tests
