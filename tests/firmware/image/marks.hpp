// Tells ../plugin/query_meter.cpp where a query begins and ends: it sees each write, and its address is the message.
#pragma once

#include <cstdint>

#include <espalier/base/function_ref.hpp>

namespace espalier::firmware {

inline constexpr unsigned mark_count = 64;
inline constexpr unsigned end_mark = mark_count - 1;

extern "C" {
inline volatile std::uint32_t firmware_marks[mark_count] = {};
}

/// Runs the call between two marks. One function for all calls: what it adds itself is the same few instructions for
/// each.
[[gnu::noinline]] inline void measure(unsigned kind, FunctionRef<void()> call) {
    volatile std::uint32_t* stack_pointer = nullptr;
    asm volatile("mov %0, sp" : "=r"(stack_pointer)::"memory");
    firmware_marks[kind] = 1;
    stack_pointer[-1] = 1;  // nothing lives below; it tells where the stack begins that the call may use
    call();
    asm volatile("" ::: "memory");
    firmware_marks[end_mark] = 1;
}

}  // namespace espalier::firmware
