// Whether three points lie on one line, decided exactly.
#pragma once

#include <espalier/types.hpp>

namespace espalier::baker {

/// True when the three corners coincide or lie on one line: the cross product of the edges is exactly zero.
[[nodiscard]] bool has_zero_area(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace espalier::baker
