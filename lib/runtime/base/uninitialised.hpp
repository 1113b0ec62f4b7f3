// Room for objects that are written before they are read: to set each to zero first takes as long as a small query.
#pragma once

#include <cstddef>
#include <type_traits>

#include <espalier/base/compiler.hpp>

namespace espalier::detail {

/// An array of bytes, in which objects begin to live when they are written.
template <class Element, unsigned count>
class Uninitialised {
    static_assert(std::is_trivially_copyable_v<Element> && std::is_trivially_destructible_v<Element>);

public:
    Element* data() { return ESPALIER_LAUNDER(reinterpret_cast<Element*>(room_)); }
    [[nodiscard]] const Element* data() const { return ESPALIER_LAUNDER(reinterpret_cast<const Element*>(room_)); }
    Element& operator[](unsigned i) { return data()[i]; }
    const Element& operator[](unsigned i) const { return data()[i]; }

private:
    alignas(Element) std::byte room_[sizeof(Element) * count];
};

}  // namespace espalier::detail
