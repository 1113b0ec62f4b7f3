// Included once per instruction set, inside its namespace.

/// Calls the function for the kind of leaf that the blob has.
template <class Function>
[[gnu::always_inline]] inline auto with_leaves_of(const BlobData& blob, Function function) {
    if constexpr (!reads_strip_leaves) return function.template operator()<PlainLeaf>();
    else if constexpr (!reads_plain_leaves) return function.template operator()<StripLeaf>();
    else if (has_plain_leaves(blob.profile)) return function.template operator()<PlainLeaf>();
    else return function.template operator()<StripLeaf>();
}
