// Two blobs: the search of an instruction set, for touching pairs or for the least distance.
#ifndef ESPALIER_PAIRS_SEARCH_PAIRS_HPP
#define ESPALIER_PAIRS_SEARCH_PAIRS_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/pairs/search.hpp>

ESPALIER_BEGIN_SET

ESPALIER_QUERY_OF_SET QueryStatus search_pairs(const PairFrame& frame, const PairSearch& search,
                                               std::uint64_t& work) noexcept {
#if ESPALIER_SMALL_CODE
    PairVisitor visitor = {frame, search};
    return search.least != nullptr ? search_nearest(frame, visitor, *search.least, work)
                                   : walk_pair(frame, visitor, search.from, work);
#elif ESPALIER_LANES == 16
    return search.least == nullptr ? search_touching(frame, search, work) : avx2::search_pairs(frame, search, work);
#else
    if (search.least == nullptr) return search_touching(frame, search, work);
    PairVisitor visitor = {frame, search, nullptr};
    return search_nearest(frame, visitor, *search.least, work);
#endif
}

ESPALIER_END_SET

#endif
