// The library's version. The format has its own (format.hpp).
#pragma once

namespace espalier {

inline constexpr int library_version_major = 0;
inline constexpr int library_version_minor = 1;
inline constexpr int library_version_patch = 0;
inline constexpr const char* library_version = "0.1.0";

}  // namespace espalier
