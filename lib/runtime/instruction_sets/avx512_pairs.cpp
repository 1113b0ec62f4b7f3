// AVX-512: two blobs, sixteen lanes at a time; their nearest pair as with AVX2. Apart from avx512.cpp: in a larger file
// compilers inline less.
#include <runtime/instruction_sets/queries.hpp>
#if ESPALIER_HAS_AVX512
#include <runtime/lanes/avx512.hpp>

ESPALIER_BEGIN_TARGET(ESPALIER_AVX512)
namespace espalier::detail::avx512 {
#include <runtime/traversal/node_boxes.inl>
#include <runtime/pairs/search.inl>
ESPALIER_QUERY_OF_SET QueryStatus search_pairs(const PairFrame& frame, const PairSearch& search,
                                               std::uint64_t& work) noexcept {
    return search.least == nullptr ? search_touching(frame, search, work) : avx2::search_pairs(frame, search, work);
}
}  // namespace espalier::detail::avx512
ESPALIER_END_TARGET
#endif
