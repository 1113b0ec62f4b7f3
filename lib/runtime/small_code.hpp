// Whether code is dearer than time: on microcontrollers, whose flash holds a program and its blobs. The same answers by
// less code; a build for any other machine may ask for it too (the CMake option ESPALIER_SMALL_CODE), as tests do.
#pragma once

#include <cstddef>

#ifndef ESPALIER_SMALL_CODE
#if defined(__ARM_ARCH_PROFILE) && __ARM_ARCH_PROFILE == 'M'
#define ESPALIER_SMALL_CODE 1
#else
#define ESPALIER_SMALL_CODE 0
#endif
#endif

/// Before a function that is small and asked for in many places: there a copy costs several times the call.
#if ESPALIER_SMALL_CODE
#define ESPALIER_SHARED_CODE [[gnu::noinline]]
#else
#define ESPALIER_SHARED_CODE
#endif

namespace espalier::detail {

inline constexpr bool small_code = ESPALIER_SMALL_CODE != 0;

/// Of what a vector register, or two, load at once. Cores without such need not waste stack on it.
inline constexpr std::size_t register_alignment = small_code ? 4 : 16;
inline constexpr std::size_t wide_register_alignment = small_code ? 4 : 32;

}  // namespace espalier::detail
