// Room for objects that are written before they are read: to set each to zero first takes as long as a small query.
#pragma once

namespace espalier::detail {

template <class Element, unsigned count>
union Uninitialised {
    Element elements[count];

    Uninitialised() {}  // NOLINT(modernize-use-equals-default): that would be deleted
    Element& operator[](unsigned i) { return elements[i]; }
    const Element& operator[](unsigned i) const { return elements[i]; }
};

}  // namespace espalier::detail
