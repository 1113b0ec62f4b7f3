// Instruction sets are switched on for marked regions of a file, never by flags for whole files: flags would leak wide
// instructions into inline functions that other files share. Include every header before a region begins.
#pragma once

#define ESPALIER_PRAGMA(text) _Pragma(#text)
#if defined(__clang__)
#define ESPALIER_BEGIN_TARGET(features) \
    ESPALIER_PRAGMA(clang attribute push(__attribute__((target(features))), apply_to = function))
#define ESPALIER_END_TARGET ESPALIER_PRAGMA(clang attribute pop)
#else
#define ESPALIER_BEGIN_TARGET(features) ESPALIER_PRAGMA(GCC push_options) ESPALIER_PRAGMA(GCC target(features))
#define ESPALIER_END_TARGET ESPALIER_PRAGMA(GCC pop_options)
#endif
