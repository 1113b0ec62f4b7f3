#include "stack_use.hpp"

#include <ucontext.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace espalier::tests {

namespace {

constexpr std::uint64_t paint = 0xC5C5'C5C5'C5C5'C5C5;

/// Starts at a multiple of 64 always, of a vector of AVX-512: frames that hold vectors align themselves, so the sum
/// depends on the start.
struct alignas(64) PaintedStack {
    std::array<std::uint64_t, 64 * 1024 / sizeof(std::uint64_t)> words;
    PaintedStack() { words.fill(paint); }
};

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
    // One for all calls: to paint it takes longer than most queries, so each call repaints only what it has written.
    static PaintedStack stack;
    ucontext_t caller;
    ucontext_t painted;
    if (getcontext(&painted) != 0) throw std::runtime_error("getcontext failed");
    painted.uc_stack.ss_sp = stack.words.data();
    painted.uc_stack.ss_size = sizeof stack.words;
    painted.uc_link = &caller;
    measurement.call = &call;
    makecontext(&painted, run_on_painted_stack, 0);
    if (swapcontext(&caller, &painted) != 0) throw std::runtime_error("swapcontext failed");
    const auto deepest =
        std::find_if(stack.words.begin(), stack.words.end(), [](std::uint64_t word) { return word != paint; });
    if (deepest == stack.words.begin()) throw std::runtime_error("the call took the whole stack");
    const std::size_t use = measurement.top - reinterpret_cast<std::uintptr_t>(&*deepest);
    std::fill(deepest, stack.words.end(), paint);
    return use;
}

}  // namespace espalier::tests
