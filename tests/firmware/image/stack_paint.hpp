// How deep a call reaches into the stack, measured by painting what lies below and looking for the first stain.
#pragma once

#include <cstdint>

extern "C" std::uint32_t image_bss_end;

namespace espalier::firmware {

inline constexpr std::uint32_t paint = 0xC5C5C5C5u;

/// Bytes of stack that `call` uses, its own frame included. Anything that `call` needs must exist already.
template <class Call>
[[gnu::noinline]] std::uint32_t stack_used_by(const Call& call) {
    std::uint32_t* stack_pointer = nullptr;
    asm volatile("mov %0, sp" : "=r"(stack_pointer)::"memory");
    for (volatile std::uint32_t* word = &image_bss_end; word < stack_pointer; ++word) *word = paint;
    call();
    asm volatile("" ::: "memory");
    const volatile std::uint32_t* word = &image_bss_end;
    while (word < stack_pointer && *word == paint) ++word;
    return static_cast<std::uint32_t>(stack_pointer - word) * 4;
}

}  // namespace espalier::firmware
