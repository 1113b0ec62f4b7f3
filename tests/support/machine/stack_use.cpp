#include "stack_use.hpp"

#include <ucontext.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

namespace espalier::tests {

namespace {

constexpr unsigned char paint = 0xC5;
constexpr std::size_t alignment = 64;  // a vector of AVX-512

// makecontext passes ints only; the tests measure one call at a time.
struct Measurement {
    FunctionRef<void()>* call = nullptr;
    std::uintptr_t top = 0;
};
Measurement measurement;

void run_on_painted_stack() {
    measurement.top = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
    (*measurement.call)();
}

}  // namespace

std::size_t stack_use(FunctionRef<void()> call) {
    // Starts at a multiple of 64 always: frames that hold vectors align themselves, so the sum depends on the start.
    constexpr std::size_t size = 256 * 1024;
    std::vector<unsigned char> memory(size + alignment, paint);
    void* start = memory.data();
    std::size_t space = memory.size();
    if (std::align(alignment, size, start, space) == nullptr) throw std::runtime_error("std::align failed");
    const std::span<unsigned char> stack{static_cast<unsigned char*>(start), size};
    ucontext_t caller;
    ucontext_t painted;
    if (getcontext(&painted) != 0) throw std::runtime_error("getcontext failed");
    painted.uc_stack.ss_sp = stack.data();
    painted.uc_stack.ss_size = stack.size();
    painted.uc_link = &caller;
    measurement.call = &call;
    makecontext(&painted, run_on_painted_stack, 0);
    if (swapcontext(&caller, &painted) != 0) throw std::runtime_error("swapcontext failed");
    std::size_t untouched = 0;
    while (untouched < stack.size() && stack[untouched] == paint) ++untouched;
    return measurement.top - reinterpret_cast<std::uintptr_t>(stack.data()) - untouched;
}

}  // namespace espalier::tests
