// The instruction set that a header of fragments is compiled for: the scalar one, unless for_each_set.hpp has begun
// another. A fragment stands between ESPALIER_BEGIN_SET and ESPALIER_END_SET, in the namespace and the target of the
// set; what it includes stands before. Its include guard is lifted when a set ends (end_set.hpp).
#ifndef ESPALIER_BEGIN_SET
#include <runtime/lanes/scalar.hpp>
#define ESPALIER_LANES 1
#define ESPALIER_BEGIN_SET namespace espalier::detail::scalar {
#define ESPALIER_END_SET }
#endif
#include <runtime/lanes/contract.hpp>
