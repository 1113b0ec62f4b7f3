// Whether three points lie on one line, decided exactly.
#pragma once

#include <espalier/types.hpp>

namespace espalier::baker {

/// True when the three corners coincide or lie on one line: the cross product of the edges is exactly zero. Coordinates
/// are 0 or of a magnitude from 2^-200 to 2^128.
[[nodiscard]] bool has_zero_area(const Vec3d& a, const Vec3d& b, const Vec3d& c);

}  // namespace espalier::baker
