// A malloc that notes when it fails, for the limit of memory while a file is read: libraries that take memory from
// malloc make a smaller file of a failure. glibc lets a program replace malloc, and has its own under another name; the
// rest of its functions stays. Sanitizers replace malloc themselves.
#include <cstddef>

#include <import/guards/limit_guard.hpp>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || __has_feature(thread_sanitizer)
#define ESPALIER_SANITIZED_MALLOC
#endif
#endif
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
    !defined(ESPALIER_SANITIZED_MALLOC)
namespace {

void* noted(void* memory, std::size_t bytes) {
    if (memory == nullptr && bytes != 0) espalier::importer::note_failed_allocation();
    return memory;
}

}  // namespace

extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier): they are glibc's
void* __libc_malloc(std::size_t bytes);
void* __libc_calloc(std::size_t count, std::size_t bytes);
void* __libc_realloc(void* memory, std::size_t bytes);
// NOLINTEND(bugprone-reserved-identifier)

void* malloc(std::size_t bytes) noexcept { return noted(__libc_malloc(bytes), bytes); }
void* calloc(std::size_t count, std::size_t bytes) noexcept {
    return noted(__libc_calloc(count, bytes), count == 0 ? 0 : bytes);
}
void* realloc(void* memory, std::size_t bytes) noexcept { return noted(__libc_realloc(memory, bytes), bytes); }
}
#endif
