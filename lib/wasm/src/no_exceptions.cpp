// WebAssembly's C++ library cannot throw. Nothing in these programs is meant to; what does, ends them.
#include <cstddef>

extern "C" {
[[noreturn]] void* __cxa_allocate_exception(std::size_t) { __builtin_trap(); }
[[noreturn]] void __cxa_throw(void*, void*, void (*)(void*)) { __builtin_trap(); }
}
