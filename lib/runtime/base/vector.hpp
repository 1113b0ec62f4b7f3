// The compiler's own vectors: operators work on all elements, and comparisons set all bits of those where they hold.
#pragma once

#include <espalier/base/compiler.hpp>

namespace espalier::detail {

template <class Element, unsigned count>
struct VectorOf {
    using Type ESPALIER_VECTOR_BYTES(count * sizeof(Element)) = Element;
};
template <class Element, unsigned count>
using Vector = typename VectorOf<Element, count>::Type;

}  // namespace espalier::detail
