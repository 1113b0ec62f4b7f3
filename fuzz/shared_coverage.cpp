// Compiled without instrumentation: the compiler uses the two names below itself where it instruments.
#include "shared_coverage.hpp"

#include <sys/mman.h>

#include <cstring>

// Where libFuzzer's counters begin and end: the linker says so.
extern "C" {
[[gnu::weak, gnu::visibility("hidden")]] extern char __start___sancov_cntrs[];
[[gnu::weak, gnu::visibility("hidden")]] extern char __stop___sancov_cntrs[];
}

namespace espalier::fuzz {

SharedCoverage::SharedCoverage() : size_(static_cast<std::size_t>(__stop___sancov_cntrs - __start___sancov_cntrs)) {
    if (size_ == 0) return;
    void* memory = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory != MAP_FAILED) memory_ = static_cast<char*>(memory);
}

void SharedCoverage::hand_over() const {
    if (memory_ != nullptr) std::memcpy(memory_, __start___sancov_cntrs, size_);
}

void SharedCoverage::take() const {
    if (memory_ != nullptr) std::memcpy(__start___sancov_cntrs, memory_, size_);
}

}  // namespace espalier::fuzz
