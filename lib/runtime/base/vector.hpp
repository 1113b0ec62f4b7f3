// The compiler's own vectors: operators work on all elements, and comparisons set all bits of those where they hold.
#pragma once

namespace espalier::detail {

template <class Element, unsigned count>
struct VectorOf {
    using Type [[gnu::vector_size(count * sizeof(Element))]] = Element;
};
template <class Element, unsigned count>
using Vector = typename VectorOf<Element, count>::Type;

}  // namespace espalier::detail
