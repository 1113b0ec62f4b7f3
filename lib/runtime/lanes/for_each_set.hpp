// Compiles the header that ESPALIER_FRAGMENT names once for each instruction set of this build, as Google Highway does
// by foreach_target.h. The file that includes this one defines the queries of its family for all sets, and calls that
// of the machine by ESPALIER_DISPATCH.
#include <runtime/lanes/scalar.hpp>
#include <runtime/lanes/select.hpp>

#define ESPALIER_LANES 1
#if ESPALIER_X86
#define ESPALIER_BEGIN_SET     \
    ESPALIER_BEGIN_LEVEL("Os") \
    namespace espalier::detail::scalar {
#define ESPALIER_END_SET \
    }                    \
    ESPALIER_END_LEVEL
#else
#define ESPALIER_BEGIN_SET namespace espalier::detail::scalar {
#define ESPALIER_END_SET }
#endif
#include ESPALIER_FRAGMENT
#include <runtime/lanes/end_set.hpp>

#if ESPALIER_HAS_SSE42
#include <runtime/lanes/sse42.hpp>
#define ESPALIER_LANES 4
#define ESPALIER_BEGIN_SET                \
    ESPALIER_BEGIN_LEVEL("O2")            \
    ESPALIER_BEGIN_TARGET(ESPALIER_SSE42) \
    namespace espalier::detail::sse42 {
#define ESPALIER_END_SET \
    }                    \
    ESPALIER_END_TARGET  \
    ESPALIER_END_LEVEL
#include ESPALIER_FRAGMENT
#include <runtime/lanes/end_set.hpp>
#endif

#if ESPALIER_HAS_AVX2
#include <runtime/lanes/avx2.hpp>
#define ESPALIER_LANES 8
#define ESPALIER_BEGIN_SET               \
    ESPALIER_BEGIN_TARGET(ESPALIER_AVX2) \
    namespace espalier::detail::avx2 {
#define ESPALIER_END_SET \
    }                    \
    ESPALIER_END_TARGET
#include ESPALIER_FRAGMENT
#include <runtime/lanes/end_set.hpp>
#endif

#if ESPALIER_HAS_AVX512
#include <runtime/lanes/avx512.hpp>
#define ESPALIER_LANES 16
#define ESPALIER_BEGIN_SET                 \
    ESPALIER_BEGIN_TARGET(ESPALIER_AVX512) \
    namespace espalier::detail::avx512 {
#define ESPALIER_END_SET \
    }                    \
    ESPALIER_END_TARGET
#include ESPALIER_FRAGMENT
#include <runtime/lanes/end_set.hpp>
#endif

#if ESPALIER_NEON
#include <runtime/lanes/neon.hpp>
#define ESPALIER_LANES 4
#define ESPALIER_BEGIN_SET namespace espalier::detail::neon {
#define ESPALIER_END_SET }
#include ESPALIER_FRAGMENT
#include <runtime/lanes/end_set.hpp>
#endif

#if ESPALIER_SIMD128
#include <runtime/lanes/simd128.hpp>
#define ESPALIER_LANES 4
#define ESPALIER_BEGIN_SET namespace espalier::detail::simd128 {
#define ESPALIER_END_SET }
#include ESPALIER_FRAGMENT
#include <runtime/lanes/end_set.hpp>
#endif

#undef ESPALIER_FRAGMENT
