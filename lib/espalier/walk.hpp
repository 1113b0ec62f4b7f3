// Walking over what a blob holds.
#pragma once

#include <espalier/blob.hpp>
#include <espalier/function_ref.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// Every triangle but copies in storage order, its corners rounded to float, until the visitor answers stop. True when
/// it saw all.
bool for_each_triangle(const Blob& blob, FunctionRef<Visit(Triangle, const Corners&)> visit);

}  // namespace espalier
