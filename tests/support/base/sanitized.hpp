// Whether the address sanitizer watches this program: GCC says so by a macro, clang by a feature.
#pragma once

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define ESPALIER_TESTS_SANITIZED 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
#define ESPALIER_TESTS_SANITIZED 1
#endif

namespace espalier::tests {

#if defined(ESPALIER_TESTS_SANITIZED)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace espalier::tests
