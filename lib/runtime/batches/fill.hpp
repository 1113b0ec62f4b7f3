// What batches have in common: their refusals, and loops over their queries.
#pragma once

#include <cstddef>
#include <span>

#include <espalier/batches/arrays.hpp>
#include <espalier/blob.hpp>

namespace espalier::detail {

/// Returns ok where a batch of `count` queries may write; arrays that it needs are null or not.
template <class... Arrays>
QueryStatus check_arrays(const Blob& blob, std::size_t count, const Arrays&... arrays) {
    if (!blob) return QueryStatus::not_open;
    return count == 0 || (... && (arrays.first != nullptr)) ? QueryStatus::ok : QueryStatus::invalid_argument;
}

/// Returns the status of such a check, or the refusal of an array of results that is null.
template <class... Results>
QueryStatus check_results(QueryStatus status, const std::span<Results>&... results) {
    return (... && (results.empty() || results.data() != nullptr)) ? status : QueryStatus::invalid_argument;
}

/// Writes the answer to each query.
template <class Answer, class Query>
Filled fill_each(QueryStatus status, std::span<Answer> answers, Query query) {
    status = check_results(status, answers);
    if (status != QueryStatus::ok) return {0, {}, status};
    for (std::size_t i = 0; i < answers.size(); ++i) answers[i] = query(i);
    return {answers.size(), {}, status};
}

/// Has each query fill its row of the elements.
template <class Element, class Query>
Filled fill_rows(QueryStatus status, std::span<Element> elements, std::span<Filled> found, Query query) {
    status = check_results(status, elements, found);
    if (status == QueryStatus::ok && !found.empty() && elements.size() % found.size() != 0)
        status = QueryStatus::invalid_argument;
    if (status != QueryStatus::ok) return {0, {}, status};
    const std::size_t places = found.empty() ? 0 : elements.size() / found.size();
    for (std::size_t i = 0; i < found.size(); ++i) found[i] = query(i, elements.subspan(i * places, places));
    return {found.size(), {}, status};
}

/// Has each query visit the elements of its list. A list that does not fit is visited to its end, for its length.
template <class Element, class Query>
FilledLists fill_lists(QueryStatus status, std::span<QueryStatus> statuses, std::span<std::size_t> offsets,
                       std::span<Element> elements, Query query) {
    FilledLists filled;
    filled.status = check_results(status, statuses, offsets, elements);
    if (filled.status == QueryStatus::ok && (offsets.empty() || offsets.size() - 1 != statuses.size()))
        filled.status = QueryStatus::invalid_argument;
    if (filled.status != QueryStatus::ok) return filled;
    offsets[0] = 0;
    for (; filled.lists < statuses.size(); ++filled.lists) {
        const std::span<Element> room = elements.subspan(filled.count);
        std::size_t found = 0;
        const QueryStatus answered = query(filled.lists, [&](const Element& element) {
            if (found < room.size()) room[found] = element;
            ++found;
        });
        if (found > room.size()) {
            filled.needed = found;
            filled.status = QueryStatus::output_full;
            return filled;
        }
        filled.count += found;
        statuses[filled.lists] = answered;
        offsets[filled.lists + 1] = filled.count;
    }
    return filled;
}

}  // namespace espalier::detail
