// What keeps a compiler from fetching ahead or in pieces.
#pragma once

namespace espalier::detail {

/// The same pointer or number, as if it could be another one each time: what it leads to is in the cache, and fetched
/// ahead of a loop it would overflow the registers and be kept on the stack a second time. A word that is loaded stays
/// one word, too.
template <class T>
[[gnu::always_inline]] inline T as_if_changed(T x) {
    __asm__ volatile("" : "+r"(x));
    return x;
}

}  // namespace espalier::detail
