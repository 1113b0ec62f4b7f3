// What LLVM's C++ library takes from Microsoft's C headers, and those of MinGW-w64 do not declare in Microsoft's mode.
// Included before anything else; what these functions do is of no concern, since nothing is linked.
#pragma once

#include <_mingw.h>
#undef __attribute__  // which they define as nothing
#undef __MINGW_ATTRIB_NORETURN
#define __MINGW_ATTRIB_NORETURN
#undef __MINGW_ATTRIB_DEPRECATED
#define __MINGW_ATTRIB_DEPRECATED
#undef __MINGW_NOTHROW
#define __MINGW_NOTHROW
#define _CRT_CONST_CORRECT_OVERLOADS
#include <math.h>
#include <stddef.h>

struct timespec;
extern "C" {
int at_quick_exit(void (*)());
[[noreturn]] void quick_exit(int);
void* aligned_alloc(size_t, size_t);
int timespec_get(timespec*, int);
}

template <class Number>
bool isfinite(Number);
template <class Number>
bool isinf(Number);
template <class Number>
bool isnan(Number);
template <class Number>
bool isnormal(Number);
template <class Number>
bool isgreater(Number, Number);
template <class Number>
bool isgreaterequal(Number, Number);
template <class Number>
bool isless(Number, Number);
template <class Number>
bool islessequal(Number, Number);
template <class Number>
bool islessgreater(Number, Number);
template <class Number>
bool isunordered(Number, Number);
