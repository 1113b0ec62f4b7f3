// The intrinsics of x86. GCC's immintrin.h also defines those of AVX-512, thousands of functions. A build without that
// set includes only the headers up to AVX2, which saves 90 MB of the compiler's memory.
#pragma once

#include <runtime/lanes/select.hpp>

#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 11 && !ESPALIER_HAS_AVX512 && \
    !defined(_IMMINTRIN_H_INCLUDED)
#include <nmmintrin.h>
#include <x86gprintrin.h>
#define _IMMINTRIN_H_INCLUDED  // each part requires it
#include <avxintrin.h>
#include <avx2intrin.h>
#include <fmaintrin.h>
#undef _IMMINTRIN_H_INCLUDED
#else
// GCC's own intrinsics start from a register that they leave undefined on purpose (GCC bug 105593).
ESPALIER_BEGIN_MAYBE_UNINITIALIZED
#include <immintrin.h>
ESPALIER_END_MAYBE_UNINITIALIZED
#endif
