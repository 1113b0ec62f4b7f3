// The intrinsics of x86. GCC's header defines those of AVX-512 too, some thousands of functions: where that set is not
// a part of the build, its parts for AVX2 alone take 90 MB of memory less.
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
#include <immintrin.h>
#endif
