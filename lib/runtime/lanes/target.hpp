// Instruction sets are switched on for marked regions of a file, never by flags for whole files: flags would leak wide
// instructions into inline functions that other files share. Include every header before a region begins. Vectors are
// reinterpreted by __builtin_bit_cast: std::bit_cast is a function from outside, and Clang returns none of them from
// it.
#pragma once

#define ESPALIER_PRAGMA(text) _Pragma(#text)
#if defined(__clang__)
#define ESPALIER_BEGIN_TARGET(features) \
    ESPALIER_PRAGMA(clang attribute push(__attribute__((target(features))), apply_to = function))
#define ESPALIER_END_TARGET ESPALIER_PRAGMA(clang attribute pop)
#else
// Without -Wpsabi: no function outside of these regions takes or returns a vector.
#define ESPALIER_BEGIN_TARGET(features)               \
    ESPALIER_PRAGMA(GCC diagnostic ignored "-Wpsabi") \
    ESPALIER_PRAGMA(GCC push_options) ESPALIER_PRAGMA(GCC target(features))
#define ESPALIER_END_TARGET ESPALIER_PRAGMA(GCC pop_options)
#endif
